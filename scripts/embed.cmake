# Writes OUT, a C++ source that holds the text of each of FILES (paths below ROOT).
# cmake -DOUT=x.cpp -DROOT=schemas -DFILES="a.proto;b.proto" -P embed.cmake
set(text "#include \"seautils/schema/builtin_files.hpp\"\n\nnamespace seautils::schema {\n\n")
string(APPEND text "const std::vector<BuiltinFile>& builtin_files() {\n")
string(APPEND text "    static const std::vector<BuiltinFile> files = {\n")
foreach(file ${FILES})
  file(READ ${ROOT}/${file} content)
  string(APPEND text "        {\"${file}\", R\"proto(${content})proto\"},\n")
endforeach()
string(APPEND text "    };\n    return files;\n}\n\n}  // namespace seautils::schema\n")
file(WRITE ${OUT} "${text}")
