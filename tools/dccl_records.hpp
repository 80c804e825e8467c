// Messages as records of the link: what dccl-encode writes with --records or --send, and dccl-decode
// reads with --records.
#ifndef SEAUTILS_TOOLS_DCCL_RECORDS_HPP
#define SEAUTILS_TOOLS_DCCL_RECORDS_HPP

#include "record_io.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"
#include "seautils/dccl/type_set.hpp"
#include "seautils/record/duplicates.hpp"
#include "seautils/schema/field_path.hpp"
#include "seautils/stream/packet_socket.hpp"

#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace seautils::tools {

constexpr std::uint32_t highest_modem_id = 30;

/// What dccl-encode is told of the records that it writes.
struct MessageRecordOptions {
    bool records = false;
    std::string socket;
    std::string src_field, dest_field, time_field;
    std::optional<std::uint32_t> src, dest;

    /// Whether to ask for acknowledgements; nothing: as the queue is configured.
    std::optional<bool> ack() const {
        return ack_option_->count() > 0 ? std::optional(ask_) : std::nullopt;
    }

    void add(CLI::App& app) {
        app.add_flag("--records", records, "Write message records, for queue-sched");
        app.add_option("--send", socket, "Hand them to queue-sched --listen SOCKET instead")
            ->option_text("SOCKET");
        app.add_option("--src-field", src_field, "Field of the message that is its sender")
            ->option_text("PATH");
        app.add_option("--dest-field", dest_field, "The same of its receiver")->option_text("PATH");
        app.add_option("--time-field", time_field, "The same of its time")->option_text("PATH");
        app.add_option("--src", src, "Sender of all messages, 1 to 30")->option_text("ID");
        app.add_option("--dest", dest, "Receiver of all messages, 0 to 30; 0: everybody")
            ->option_text("ID");
        ack_option_ =
            app.add_flag("--ack,!--no-ack", ask_, "Ask for acknowledgements, or ask for none");
    }

    bool wanted() const { return records || !socket.empty(); }

    /// @throws Error(usage)
    void check() const {
        const auto usage = [](const std::string& what) { throw Error(ExitCode::usage, what); };
        const bool any = !src_field.empty() || !dest_field.empty() || !time_field.empty() || src ||
                         dest || ack();
        if (any && !wanted()) usage("options of records need --records or --send");
        if (src && !src_field.empty()) usage("options --src and --src-field exclude each other");
        if (dest && !dest_field.empty())
            usage("options --dest and --dest-field exclude each other");
        if (src && (*src < 1 || *src > highest_modem_id)) usage("option --src: outside 1 to 30");
        if (dest && *dest > highest_modem_id) usage("option --dest: outside 0 to 30");
    }

private:
    bool ask_ = false;
    CLI::Option* ack_option_ = nullptr;
};

/// Makes message records of encoded messages.
class MessageRecordWriter {
public:
    MessageRecordWriter(cli::Io& io, const MessageRecordOptions& options)
        : io_(io), options_(options), records_(io) {
        if (!options.socket.empty()) client_.emplace(options.socket);
    }

    /// @throws DataError  a field that the options name is not set or has no such value; the record
    ///                    is too large; the queue does not take it
    void write(const dccl::Type& type, const schema::Values& values, const std::string& bytes) {
        record::Message message;
        message.id = type.legacy != nullptr ? type.legacy->id()
                                            : static_cast<std::uint32_t>(type.program->id());
        message.src = options_.src.value_or(0);
        message.dest = options_.dest.value_or(0);
        if (!options_.src_field.empty())
            message.src = modem_id(options_.src_field, 1, type, values);
        if (!options_.dest_field.empty())
            message.dest = modem_id(options_.dest_field, 0, type, values);
        if (!options_.time_field.empty()) message.created = time(type, values);
        message.ack_requested = options_.ack();
        message.data = bytes;
        message.type = type.name;
        record_.time.ns = io_.clock.now_ns();
        record_.kind = std::move(message);
        client_ ? send() : records_.write(record_);
    }

private:
    using Slot = schema::Slot;

    const Slot& slot(const std::string& path, const dccl::Type& type, const schema::Values& values,
                     const schema::Field*& field) {
        auto found = paths_.find({&type, path});
        if (found == paths_.end())
            found =
                paths_.emplace(std::pair{&type, path}, schema::FieldPath(*type.layout, path)).first;
        field = &found->second.field();
        const Slot* at = found->second.find(values);
        if (at == nullptr) throw DataError(path + " is not set, and the record needs it");
        return *at;
    }

    std::uint32_t modem_id(const std::string& path, std::int64_t least, const dccl::Type& type,
                           const schema::Values& values) {
        const schema::Field* field = nullptr;
        const Slot& at = slot(path, type, values, field);
        using enum schema::Kind;
        if (field->kind == string || field->kind == bytes || field->kind == boolean)
            throw ConfigError("field " + quote(path) + " is no number");
        const bool real = field->kind == float32 || field->kind == float64;
        const double value = real ? at.d : static_cast<double>(at.i);
        if (value != std::trunc(value) || value < static_cast<double>(least) ||
            value > highest_modem_id)
            throw DataError(path + " is outside " + std::to_string(least) + " to 30: no modem ID");
        return static_cast<std::uint32_t>(value);
    }

    /// Seconds since 1970 in a floating-point or 32-bit field, microseconds in a 64-bit one, or a text.
    record::UtcTime time(const dccl::Type& type, const schema::Values& values) {
        const schema::Field* field = nullptr;
        const Slot& at = slot(options_.time_field, type, values, field);
        switch (field->kind) {
            case schema::Kind::float32:
            case schema::Kind::float64:
                return in_range(at.d * 1e9);
            case schema::Kind::int64:
            case schema::Kind::uint64:
                return in_range(static_cast<double>(at.i) * 1e3, at.i * 1000);
            case schema::Kind::int32:
            case schema::Kind::uint32:
                return in_range(static_cast<double>(at.i) * 1e9, at.i * 1'000'000'000);
            case schema::Kind::string:
                return {parse_utc_ns(values.text(at))};
            default:
                throw ConfigError("field " + quote(options_.time_field) + " is no time");
        }
    }

    record::UtcTime in_range(double ns, std::optional<std::int64_t> exact = {}) const {
        if (!(ns >= 0 && ns < 9.2e18))
            throw DataError(options_.time_field + " is outside the years 1970 to 2261");
        return {exact ? *exact : std::llround(ns / 1000) * 1000};
    }

    void send() {
        packet_.clear();
        records_.codec().write(record_, record::Form::ndjson, packet_);
        packet_.pop_back();
        const std::string answer = client_->ask(packet_, std::chrono::seconds(10));
        if (answer == "ok") return;
        throw DataError("the queue refuses it: " + printable(answer, 200));
    }

    cli::Io& io_;
    const MessageRecordOptions& options_;
    RecordIo records_;
    std::optional<stream::PacketClient> client_;
    std::map<std::pair<const dccl::Type*, std::string>, schema::FieldPath> paths_;
    record::Record record_;
    std::string packet_;
};

/// What dccl-decode is told of the records that it reads.
struct ReceptionRecordOptions {
    bool records = false;
    bool received = false;
    double duplicates_s = 0;

    void add(CLI::App& app) {
        app.add_flag("--records", records, "Read reception records, of mm-serial");
        app.add_flag("--received", received,
                     "Say when and from whom, as \"@received\" and \"@from\"");
        app.add_option("--duplicates", duplicates_s,
                       "Drop messages that came before within SECONDS, from the same sender")
            ->option_text("SECONDS");
    }

    /// @throws Error(usage)
    void check() const {
        if (duplicates_s != 0 && !records)
            throw Error(ExitCode::usage, "option --duplicates needs --records");
        if (received && !records) throw Error(ExitCode::usage, "option --received needs --records");
        if (!(duplicates_s >= 0 && duplicates_s <= 1e7))
            throw Error(ExitCode::usage, "option --duplicates: outside 0 to 10000000 s");
    }
};

/// Takes the frames out of reception records.
class ReceptionReader {
public:
    ReceptionReader(cli::Io& io, const ReceptionRecordOptions& options)
        : records_(io), io_(io), received_(options.received) {
        if (options.duplicates_s > 0)
            duplicates_.emplace(static_cast<std::int64_t>(options.duplicates_s * 1e9));
    }

    /// Calls `decode` with each frame that arrived; records of other kinds hold none.
    /// @throws DataError  no record; or `decode` threw: says of which frames, and what
    void frames(std::string_view bytes, const std::function<void(std::string_view frame)>& decode) {
        const record::Record& record = records_.read(bytes);
        const record::Reception* heard = record.as<record::Reception>();
        if (heard == nullptr || heard->kind != record::Kind::data) return;
        src_ = heard->src;
        time_ns_ = record.time.ns;
        for (const std::uint32_t bad : heard->bad_frame)
            io_.inform("frame " + std::to_string(bad) + " from " + std::to_string(src_) +
                       " was lost");
        std::string wrong;
        for (std::size_t k = 0; k < heard->frame.size(); ++k) {
            try {
                if (!heard->frame[k].empty()) decode(heard->frame[k]);
            } catch (const DataError& e) {
                wrong +=
                    (wrong.empty() ? "frame " : "; frame ") + std::to_string(k) + ": " + e.what();
            }
        }
        if (!wrong.empty()) throw DataError(wrong);
    }

    std::int64_t time_ns() const { return time_ns_; }
    std::uint32_t src() const { return src_; }

    /// With --received: puts when and from whom into the JSON object that begins at `at`.
    void add_received(std::string& out, std::size_t at) const {
        if (!received_) return;
        std::string said = "\"@received\":\"" + format_utc_ns(time_ns_) + "\",\"@from\":";
        said += std::to_string(src_);
        if (out[at + 1] != '}') said += ',';
        out.insert(at + 1, said);
    }

    /// Whether the message came before, and is to be dropped.
    bool is_again(std::string_view message) {
        return duplicates_ && duplicates_->is_again(src_, message, time_ns_);
    }

private:
    RecordIo records_;
    cli::Io& io_;
    bool received_;
    std::optional<record::Duplicates> duplicates_;
    std::uint32_t src_ = 0;
    std::int64_t time_ns_ = 0;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DCCL_RECORDS_HPP
