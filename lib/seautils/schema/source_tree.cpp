#include "seautils/schema/source_tree.hpp"

#include "seautils/core/error.hpp"
#include "seautils/schema/builtin_files.hpp"
#include "seautils/schema/source_check.hpp"

#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace seautils::schema {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_file_bytes = 1U << 20;
constexpr std::size_t max_files = 1000;
constexpr std::size_t max_bytes = 1U << 24;  ///< in all
constexpr int parent_folders = 4;

/// A stream that owns its text.
class OwnedText : public google::protobuf::io::ZeroCopyInputStream {
public:
    explicit OwnedText(std::string text)
        : text_(std::move(text)), stream_(text_.data(), static_cast<int>(text_.size())) {}
    bool Next(const void** data, int* size) override { return stream_.Next(data, size); }
    void BackUp(int count) override { stream_.BackUp(count); }
    bool Skip(int count) override { return stream_.Skip(count); }
    std::int64_t ByteCount() const override { return stream_.ByteCount(); }

private:
    std::string text_;
    google::protobuf::io::ArrayInputStream stream_;
};

}  // namespace

bool is_builtin_path(const std::string& path) {
    const auto& files = builtin_files();
    return std::any_of(files.begin(), files.end(), [&](const BuiltinFile& f) {
        return path == f.path || path.ends_with("/" + std::string(f.path));
    });
}

std::string SourceTree::add_file(const std::string& path) {
    std::error_code error;
    const fs::path absolute = fs::canonical(path, error);
    if (error) throw Error(ExitCode::no_input, path + ": " + error.message());
    if (!fs::is_regular_file(absolute))
        throw Error(ExitCode::no_input, path + ": not a regular file");
    std::vector<std::string> bases;
    fs::path folder = absolute.parent_path();
    for (int k = 0; k <= parent_folders && folder != folder.root_path(); ++k) {
        bases.push_back(folder.string());
        folder = folder.parent_path();
    }
    for (const std::string& base : bases_) {
        if (std::find(bases.begin(), bases.end(), base) == bases.end()) bases.push_back(base);
    }
    bases_ = std::move(bases);
    const std::string name = absolute.string().substr(1);
    paths_[name] = absolute.string();
    shown_[name] = path;
    return name;
}

std::string SourceTree::add_text(const std::string& name, const std::string& text) {
    if (text.size() > max_file_bytes) throw ConfigError(name + ": larger than 1 MiB");
    texts_[name] = text;
    return name;
}

std::string SourceTree::shown(const std::string& name) const {
    const auto at = shown_.find(name);
    if (at != shown_.end()) return at->second;
    const auto path = paths_.find(name);
    return path == paths_.end() ? name : path->second;
}

std::string SourceTree::find(const std::string& import) const {
    if (import.empty() || import.front() == '/' || import.find('\0') != std::string::npos)
        return {};
    for (const auto* folders : {&bases_, &import_folders_}) {
        for (const std::string& folder : *folders) {
            std::error_code error;
            const fs::path path = fs::canonical(fs::path(folder) / import, error);
            if (!error && fs::is_regular_file(path, error)) return path.string();
        }
    }
    return {};
}

google::protobuf::io::ZeroCopyInputStream* SourceTree::serve(std::string text) {
    if (++opened_ > 2 * max_files) {
        error_ = "more than 1000 files";
        return nullptr;
    }
    bytes_ += text.size();
    error_ = bytes_ > max_bytes ? "more than 16 MiB in all" : source_fault(text);
    if (!error_.empty()) return nullptr;
    return new OwnedText(std::move(text));
}

google::protobuf::io::ZeroCopyInputStream* SourceTree::open_file(const std::string& path) {
    std::error_code error;
    if (fs::file_size(path, error) > max_file_bytes || error) {
        error_ = error ? error.message() : "larger than 1 MiB";
        return nullptr;
    }
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad()) {
        error_ = std::strerror(errno);
        return nullptr;
    }
    return serve(std::move(text));
}

google::protobuf::io::ZeroCopyInputStream* SourceTree::Open(const std::string& name) {
    error_ = "not found";
    for (const BuiltinFile& file : builtin_files()) {
        if (name == file.path) return serve(std::string(file.text));
    }
    if (name.starts_with("google/protobuf/")) return nullptr;  // those of the library
    if (const auto text = texts_.find(name); text != texts_.end()) return serve(text->second);
    if (const auto path = paths_.find(name); path != paths_.end()) return open_file(path->second);
    const std::string path = find(name);
    if (path.empty()) return nullptr;
    const std::string target = path.substr(1);
    paths_.emplace(target, path);
    return serve("syntax = \"proto2\"; import public \"" + target + "\";");
}

}  // namespace seautils::schema
