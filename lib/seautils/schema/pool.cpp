#include "seautils/schema/pool.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/schema/builtin_files.hpp"
#include "seautils/schema/source_tree.hpp"

#include <google/protobuf/any.pb.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/descriptor_database.h>
#include <google/protobuf/duration.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/empty.pb.h>
#include <google/protobuf/field_mask.pb.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/timestamp.pb.h>
#include <google/protobuf/wrappers.pb.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace seautils::schema {

namespace {

namespace fs = std::filesystem;
using google::protobuf::Descriptor;
using google::protobuf::FileDescriptor;

constexpr std::size_t max_files = 1000;
constexpr std::size_t max_text_bytes = 1U << 20;
constexpr int max_folder_depth = 16;
/// Bytes of what is said of a schema, in which paths and names may be of any length.
constexpr std::size_t longest_fault = 1200;

/// Keeps the first faults that protobuf finds.
class Faults : public google::protobuf::compiler::MultiFileErrorCollector {
public:
    explicit Faults(const SourceTree& tree) : tree_(tree) {}

    void AddError(const std::string& file, int line, int column,
                  const std::string& message) override {
        const std::string text = one_line(message);
        if (line < 0) {
            if (unplaced_.empty()) unplaced_ = tree_.shown(file) + ": " + text;
        } else if (placed_.empty()) {
            placed_ = tree_.shown(file) + ":" + std::to_string(line + 1) + ":" +
                      std::to_string(column + 1) + ": " + text;
        }
    }
    void clear() { placed_.clear(), unplaced_.clear(); }
    /// The first fault with a place and, where it is an import that failed, why.
    std::string what() const {
        std::string said = placed_.empty() ? unplaced_ : placed_;
        const bool import = placed_.find("was not found or had errors") != std::string::npos;
        if (import && !unplaced_.empty()) said += " (" + unplaced_ + ")";
        return printable(said, longest_fault);
    }

private:
    static std::string one_line(std::string text) {
        std::replace(text.begin(), text.end(), '\n', ' ');
        while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
        return printable(lower_first(std::move(text)), 300);
    }

    const SourceTree& tree_;
    std::string placed_, unplaced_;
};

/// The files that protobuf itself brings, from its own descriptors.
void add_well_known(google::protobuf::SimpleDescriptorDatabase& database) {
    for (const FileDescriptor* file : {google::protobuf::FileDescriptorProto::descriptor()->file(),
                                       google::protobuf::Any::descriptor()->file(),
                                       google::protobuf::Duration::descriptor()->file(),
                                       google::protobuf::Empty::descriptor()->file(),
                                       google::protobuf::FieldMask::descriptor()->file(),
                                       google::protobuf::Struct::descriptor()->file(),
                                       google::protobuf::Timestamp::descriptor()->file(),
                                       google::protobuf::Int32Value::descriptor()->file()}) {
        google::protobuf::FileDescriptorProto proto;
        file->CopyTo(&proto);
        database.Add(proto);
    }
}

void find_protos(const fs::path& folder, int depth, std::vector<std::string>& found) {
    std::vector<fs::path> entries;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) entries.push_back(entry.path());
    if (error) throw Error(ExitCode::no_input, folder.string() + ": " + error.message());
    std::sort(entries.begin(), entries.end());
    for (const fs::path& path : entries) {
        if (path.filename().string().starts_with('.')) continue;
        if (fs::is_directory(path, error)) {
            if (depth == max_folder_depth)
                throw ConfigError(path.string() + ": folders are nested deeper than 16");
            find_protos(path, depth + 1, found);
        } else if (path.extension() == ".proto" && !is_builtin_path(path.string())) {
            found.push_back(path.string());
        }
        if (found.size() > max_files)
            throw ConfigError(folder.string() + ": more than 1000 .proto files");
    }
}

/// What comes out of a pipe; one byte more than a schema may have where it is too long.
std::string text_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in.is_open()) throw Error(ExitCode::no_input, path + ": " + std::strerror(errno));
    std::string text(max_text_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

void collect(const Descriptor& message, std::vector<const Descriptor*>& all) {
    if (message.options().map_entry()) return;
    all.push_back(&message);
    for (int k = 0; k < message.nested_type_count(); ++k) collect(*message.nested_type(k), all);
}

}  // namespace

struct Pool::Impl {
    explicit Impl(std::vector<std::string> import_folders)
        : tree(std::move(import_folders)),
          faults(tree),
          database(&tree, &well_known),
          pool(&database, database.GetValidationErrorCollector()) {
        add_well_known(well_known);
        database.RecordErrorsTo(&faults);
        pool.EnforceWeakDependencies(true);
    }

    SourceTree tree;
    Faults faults;
    google::protobuf::SimpleDescriptorDatabase well_known;
    google::protobuf::compiler::SourceTreeDescriptorDatabase database;
    google::protobuf::DescriptorPool pool;
    mutable google::protobuf::DynamicMessageFactory factory;
    LayoutSet layouts;
    std::vector<const FileDescriptor*> files;

    void compile(const std::string& name) {
        faults.clear();
        const google::protobuf::LogSilencer silence;  // it would print of a file without syntax
        const FileDescriptor* file = pool.FindFileByName(name);
        if (file == nullptr)
            throw ConfigError(faults.what().empty() ? name + ": not found" : faults.what());
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    }
};

Pool::Pool(std::vector<std::string> import_folders)
    : impl_(std::make_unique<Impl>(std::move(import_folders))) {}
Pool::~Pool() = default;
Pool::Pool(Pool&&) noexcept = default;
Pool& Pool::operator=(Pool&&) noexcept = default;

void Pool::load(const std::string& path) {
    for (const BuiltinFile& file : builtin_files()) {
        if (is_builtin_path(path) && path.ends_with(file.path))
            return impl_->compile(std::string(file.path));
    }
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if (type == fs::file_type::fifo || type == fs::file_type::character) {
        return load_text(path, text_of(path));
    }
    if (type != fs::file_type::directory) return impl_->compile(impl_->tree.add_file(path));
    std::vector<std::string> found;
    find_protos(path, 0, found);
    if (found.empty()) throw Error(ExitCode::no_input, path + ": no .proto file in this folder");
    for (const std::string& file : found) impl_->compile(impl_->tree.add_file(file));
}

void Pool::load_text(const std::string& name, const std::string& text) {
    impl_->compile(impl_->tree.add_text(name, text));
}

const std::vector<const FileDescriptor*>& Pool::files() const { return impl_->files; }

std::vector<const Descriptor*> Pool::messages() const {
    std::vector<const Descriptor*> all;
    for (const FileDescriptor* file : impl_->files) {
        for (int k = 0; k < file->message_type_count(); ++k) collect(*file->message_type(k), all);
    }
    return all;
}

const Descriptor& Pool::message(const std::string& name) const {
    if (const Descriptor* found = impl_->pool.FindMessageTypeByName(name)) return *found;
    const Descriptor* found = nullptr;
    std::vector<std::string> names;
    for (const Descriptor* message : messages()) {
        names.push_back(message->full_name());
        if (!message->full_name().ends_with("." + name)) continue;
        if (found != nullptr) {
            throw ConfigError("message " + quote(name) + " is ambiguous: " + found->full_name() +
                              " or " + message->full_name());
        }
        found = message;
    }
    if (found != nullptr) return *found;
    const std::string near = nearest(name, names);
    throw ConfigError("message " + quote(name) + " is not in the schema" +
                      (near.empty() ? "" : " (did you mean '" + near + "'?)"));
}

std::string Pool::place(const Descriptor& descriptor, std::string_view path) const {
    google::protobuf::SourceLocation location;
    const FileDescriptor* file = descriptor.file();
    bool known = descriptor.GetSourceLocation(&location);
    for (const Descriptor* message = &descriptor; message != nullptr && !path.empty();) {
        const std::string_view name = path.substr(0, path.find_first_of(".["));
        const auto* field = message->FindFieldByName(std::string(name));
        if (field == nullptr || !field->GetSourceLocation(&location)) break;
        known = true;
        file = field->file();
        message = field->message_type();
        path.remove_prefix(std::min(path.find('.', name.size()), path.size() - 1) + 1);
    }
    const std::string line = known ? std::to_string(location.start_line + 1) + ": " : " ";
    return impl_->tree.shown(file->name()) + ":" + line;
}

std::unique_ptr<google::protobuf::Message> Pool::new_message(const Descriptor& descriptor) const {
    return std::unique_ptr<google::protobuf::Message>(
        impl_->factory.GetPrototype(&descriptor)->New());
}

const Layout& Pool::layout(const Descriptor& descriptor) { return impl_->layouts.of(descriptor); }

}  // namespace seautils::schema
