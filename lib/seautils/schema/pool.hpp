#ifndef SEAUTILS_SCHEMA_POOL_HPP
#define SEAUTILS_SCHEMA_POOL_HPP

#include "seautils/schema/layout.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::schema {

/// A set of .proto files, compiled at run time.
///
/// A file's imports are looked for in: the files built into seautils (`dccl/option_extensions.proto`
/// and its four neighbours, `google/protobuf/*.proto`), then the folder that the file itself lies in
/// and its parents up to four levels (so that `import "a/b.proto"` works from within a/), then the
/// folders given to the constructor. Limits: 1 MiB a file, 16 MiB and 1000 files
/// in all, 100,000 fields, and those of source_check.hpp.
class Pool {
public:
    explicit Pool(std::vector<std::string> import_folders = {});
    ~Pool();
    Pool(Pool&&) noexcept;
    Pool& operator=(Pool&&) noexcept;

    /// Compiles a file, or each .proto file in a folder and up to 16 folders below it, in order of name.
    /// A file that was compiled already is not compiled twice. A pipe is read to its end.
    /// @throws Error(no_input)  cannot be opened
    /// @throws ConfigError      `FILE:LINE:COLUMN: what`, one line, the first fault
    void load(const std::string& path);

    /// Compiles a text as if it were a file of that name (tests, fuzzing).
    void load_text(const std::string& name, const std::string& text);

    /// Files given to load, in the order of compilation; imported files are not in it.
    const std::vector<const google::protobuf::FileDescriptor*>& files() const;

    /// Message types declared in files(), nested ones too, in order of declaration; no map entries.
    std::vector<const google::protobuf::Descriptor*> messages() const;

    /// The type of that full name, or, where only one type ends in `.name`, that one.
    /// @throws ConfigError  unknown (proposes the nearest name), or ambiguous (lists them)
    const google::protobuf::Descriptor& message(const std::string& name) const;

    /// Where a type, or a field of it, is declared: `FILE:LINE: `, for messages.
    /// @param path  of the field, `leg[].seq`; empty for the type; as much of it as is known counts
    std::string place(const google::protobuf::Descriptor& descriptor, std::string_view path) const;

    /// A new message of a run-time type. The pool must outlive it.
    std::unique_ptr<google::protobuf::Message> new_message(
        const google::protobuf::Descriptor& descriptor) const;

    /// Its layout; made at the first call.
    const Layout& layout(const google::protobuf::Descriptor& descriptor);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_POOL_HPP
