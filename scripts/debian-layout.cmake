# Run by cpack before it makes the packages: puts files where Debian has them.
file(GLOB pages ${CPACK_TEMPORARY_DIRECTORY}/*/*/share/man/man[1-9]/*.[1-9])
foreach(page ${pages})
  execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB folders ${CPACK_TEMPORARY_DIRECTORY}/*/*/share/zsh/site-functions)
foreach(folder ${folders})
  file(RENAME ${folder} ${folder}/../vendor-completions)
endforeach()
