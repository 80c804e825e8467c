#ifndef SEAUTILS_SCHEMA_SOURCE_TREE_HPP
#define SEAUTILS_SCHEMA_SOURCE_TREE_HPP

#include <google/protobuf/compiler/importer.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace seautils::schema {

/// Finds the .proto files that a schema is made of.
///
/// A file on disk is known to protobuf by its absolute path, so that it is one file by whatever
/// name it is reached; an import is answered with a file of one line that imports it publicly.
class SourceTree : public google::protobuf::compiler::SourceTree {
public:
    explicit SourceTree(std::vector<std::string> import_folders)
        : import_folders_(std::move(import_folders)) {}

    /// Makes a file known and returns its name for protobuf. Its folder, and four folders above
    /// it, are where imports are looked for first, until the next file is added.
    std::string add_file(const std::string& path);
    std::string add_text(const std::string& name, const std::string& text);

    /// The name that people know a file by.
    std::string shown(const std::string& name) const;

    google::protobuf::io::ZeroCopyInputStream* Open(const std::string& name) override;
    std::string GetLastErrorMessage() override { return error_; }

private:
    google::protobuf::io::ZeroCopyInputStream* serve(std::string text);
    google::protobuf::io::ZeroCopyInputStream* open_file(const std::string& path);
    std::string find(const std::string& import) const;

    std::vector<std::string> import_folders_;
    std::vector<std::string> bases_;            ///< of the file added last, then of those before
    std::map<std::string, std::string> paths_;  ///< by protobuf's name
    std::map<std::string, std::string> shown_;
    std::map<std::string, std::string> texts_;
    std::size_t opened_ = 0, bytes_ = 0;
    std::string error_;
};

/// Whether the path names one of the built-in import files, wherever it lies.
bool is_builtin_path(const std::string& path);

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_SOURCE_TREE_HPP
