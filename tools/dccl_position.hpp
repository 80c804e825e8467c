// The field codec seautils.position: what dccl-encode, dccl-decode and dccl-info join of dccl and
// position.
#ifndef SEAUTILS_TOOLS_DCCL_POSITION_HPP
#define SEAUTILS_TOOLS_DCCL_POSITION_HPP

#include "dccl_position_acks.hpp"
#include "dccl_position_form.hpp"
#include "dccl_position_state.hpp"

#include "seautils/cli/app.hpp"
#include "seautils/dccl/field_codec.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace seautils::tools {

struct PositionOptions {
    std::string state, acks;

    void add(CLI::App& app, const char* acks_help) {
        app.add_option("--position-state", state, "Keep what is known of positions in this file")
            ->option_text("FILE");
        app.add_option("--position-acks", acks, acks_help)->option_text("FILE");
    }
};

enum class PositionEnd { none, sender, receiver };

/// The tracks of all fields with this codec, at one end.
class PositionTracks {
public:
    PositionTracks(cli::Io& io, PositionEnd end, const PositionOptions& options = {})
        : io_(io), end_(end), state_(options.state, io), acks_(options.acks, io) {}

    /// Vehicle that what is decoded next comes from; 0: not known.
    void set_src(std::uint32_t src) { src_ = src; }

    /// Before a message is encoded: what arrived since the last one.
    void hear() {
        acks_.read([this](const std::string& ack) {
            for (auto& [track, sender] : senders_) {
                using enum position::Sender::Heard;
                if (sender->acknowledge(ack) != nothing) state_.keep(track, *sender);
            }
        });
    }
    /// After one was coded, and before its bytes, or acknowledgements, leave.
    void settle() {
        state_.write();
        for (const auto& [dest, ack] : due_) acks_.write(dest, ack);
        due_.clear();
    }

    /// Where they are sent: makes the end of a track, so that it hears what there is to hear before
    /// its first message.
    void add(const std::string& track, const PositionForm& form) {
        if (end_ != PositionEnd::sender) return;
        auto& sender = senders_[track];
        if (sender) return;
        sender = std::make_unique<position::FieldSender>(form.link, form.codec);
        state_.restore(track, *sender);
    }

    void encode(const std::string& track, const PositionForm& form, const position::Fix& fix,
                entropy::BitString& bits) {
        position::FieldSender& sender = *senders_.at(track);
        sender.put(fix, form.max_bytes, bits);
        state_.keep(track, sender);
    }

    /// The newest position that a packet brought; nothing: none that is new.
    std::optional<position::Fix> decode(const std::string& field, const PositionForm& form,
                                        const std::string& packet) {
        const std::string track = fmt::format("{} {}", field, src_);
        auto& receiver = receivers_[track];
        if (!receiver) {
            receiver = std::make_unique<position::Receiver>(
                position::make_field_receiver(form.link, form.codec));
            state_.restore(track, *receiver);
        }
        position::Arrival arrival = receiver->packet(packet);
        state_.keep(track, *receiver);
        if (!arrival.ack.empty()) due_.emplace_back(src_, std::move(arrival.ack));
        if (arrival.outcome == position::Arrival::Outcome::undecodable)
            io_.inform(fmt::format("{} of vehicle {}: {}", field, src_, arrival.why));
        if (arrival.fixes.empty()) return std::nullopt;
        return arrival.fixes.back();
    }

private:
    cli::Io& io_;
    PositionEnd end_;
    PositionState state_;
    PositionAcks acks_;
    std::uint32_t src_ = 0;
    std::map<std::string, std::unique_ptr<position::FieldSender>> senders_;
    std::map<std::string, std::unique_ptr<position::Receiver>> receivers_;
    std::vector<std::pair<std::uint32_t, std::string>> due_;
};

class PositionCodec : public dccl::FieldCodec {
public:
    /// @param tracks  outlives it
    PositionCodec(PositionTracks& tracks, unsigned check_bits)
        : tracks_(tracks), check_bits_(check_bits) {}

    Bounds bounds(const schema::Field& field, const dccl::FieldOptions& options) override {
        const PositionForm form(field, options, check_bits_);
        forms_.insert_or_assign(&field, form);
        tracks_.add(field.descriptor->full_name(), form);
        return {position::least_field_bits, position::most_field_bits(form.max_bytes, check_bits_)};
    }

    void encode(const schema::Field& field, const schema::Values& values, const schema::Slot& slot,
                dccl::BitWriter& out) override {
        const PositionForm& form = forms_.at(&field);
        const std::string& track = field.descriptor->full_name();
        entropy::BitString bits;
        tracks_.encode(track, form, form.fix(values, slot), bits);
        entropy::BitReader in(bits.bytes(), bits.size());
        while (in.left() > 0) out.put(in.get() ? 1 : 0, 1);
    }

    void decode(const schema::Field& field, dccl::BitReader& in, schema::Values& values,
                std::uint32_t slot) override {
        const PositionForm& form = forms_.at(&field);
        const auto next = [&in] { return in.get(1) != 0; };
        const std::string packet = position::get_field(next, form.max_bytes, check_bits_);
        if (packet.empty()) return;
        if (const auto fix = tracks_.decode(field.descriptor->full_name(), form, packet))
            form.put(*fix, values, slot, *field.message);
    }

private:
    PositionTracks& tracks_;
    unsigned check_bits_;
    std::map<const schema::Field*, PositionForm> forms_;
};

/// By the names that schemas call them.
inline dccl::FieldCodecs position_codecs(PositionTracks& tracks) {
    return {{"seautils.position", std::make_shared<PositionCodec>(tracks, 16)},
            {"seautils.position.check8", std::make_shared<PositionCodec>(tracks, 8)}};
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DCCL_POSITION_HPP
