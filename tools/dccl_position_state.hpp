// What dccl-encode and dccl-decode keep of positions over a restart.
#ifndef SEAUTILS_TOOLS_DCCL_POSITION_STATE_HPP
#define SEAUTILS_TOOLS_DCCL_POSITION_STATE_HPP

#include "seautils/cli/io.hpp"
#include "seautils/core/error.hpp"
#include "seautils/position/state_bytes.hpp"
#include "seautils/stream/whole_file.hpp"

#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace seautils::tools {

/// What is kept of the positions in a file: of each track, Sender::save() or Receiver::save(), by the
/// field's full name and the vehicle's modem ID.
class PositionState {
public:
    /// @param path  empty: nothing is kept
    /// A state that cannot be used is as none: positions begin anew, and none is decoded wrongly.
    PositionState(std::string path, cli::Io& io) : path_(std::move(path)), io_(io) {
        if (path_.empty()) return;
        const auto bytes = stream::read_whole_file(path_, most_bytes);
        if (bytes) use(path_, [&] { parse(*bytes); });
    }

    /// Brings an end to where it was.
    template <class End>
    void restore(const std::string& track, End& end) {
        const auto found = tracks_.find(track);
        if (found != tracks_.end()) use(path_ + ": " + track, [&] { end.load(found->second); });
    }

    template <class End>
    void keep(const std::string& track, const End& end) {
        if (path_.empty()) return;
        tracks_[track] = end.save();
        is_new_ = true;
    }

    /// @throws Error(cannot_create), Error(io)
    void write() {
        if (!std::exchange(is_new_, false)) return;
        position::StateWriter out(version);
        for (const auto& [track, state] : tracks_) {
            out.text(track);
            out.text(state);
        }
        out.text("");
        stream::replace_file(path_, out.finish(), stream::Sync::yes);
    }

private:
    static constexpr std::size_t most_bytes = std::size_t{64} << 20;
    static constexpr std::uint8_t version = 1;

    void parse(std::string_view bytes) {
        position::StateReader in(bytes, version);
        std::map<std::string, std::string> tracks;
        for (std::string track; !(track = in.text()).empty();) tracks[track] = in.text();
        in.finish();
        tracks_ = std::move(tracks);
    }

    template <class Read>
    void use(const std::string& what, Read read) const {
        try {
            read();
        } catch (const DataError& e) {
            io_.warn(what + ": " + e.what() + ": positions begin anew");
        }
    }

    std::string path_;
    cli::Io& io_;
    std::map<std::string, std::string> tracks_;
    bool is_new_ = false;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DCCL_POSITION_STATE_HPP
