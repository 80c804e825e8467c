#include "seautils/dccl/raw_stream.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/dccl/field_error.hpp"

#include <utility>

namespace seautils::dccl {

RawStream::RawStream(TypeSet& types, Decode decode, Refuse refuse)
    : types_(types), decode_(std::move(decode)), refuse_(std::move(refuse)) {}

std::size_t RawStream::take(std::string_view bytes, std::uint64_t offset, bool ended) {
    std::size_t at = 0;
    while (at < bytes.size()) {
        try {
            if (!lost_) {
                const std::size_t taken = decode_(bytes.substr(at));
                if (taken == 0) throw DataError("the message takes no bytes");
                at += taken;
                continue;
            }
            at += find(bytes.substr(at), ended);
            if (lost_) break;
            skipped(offset + at);
        } catch (const Truncated& e) {
            if (!ended) return at;
            lose(offset + at, e.what());
        } catch (const DataError& e) {
            lose(offset + at, e.what());
        }
    }
    if (ended && lost_) skipped(offset + at);
    return at;
}

/// Bytes in front of the next message; all, and still lost, where there is none yet.
std::size_t RawStream::find(std::string_view bytes, bool ended) {
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        if (!types_.may_begin(bytes[at])) continue;
        const std::string_view rest = bytes.substr(at);
        try {
            const TypeSet::Decoded decoded = types_.decode(rest, values_);
            if (decoded.bytes == 0) continue;
            again_.clear();
            types_.encode(*decoded.type, values_, again_);
            lost_ = again_ != rest.substr(0, decoded.bytes);
            if (!lost_) return at;
        } catch (const Truncated&) {
            if (!ended) return at;
        } catch (const DataError&) {
            continue;
        }
    }
    return bytes.size();
}

void RawStream::lose(std::uint64_t offset, const std::string& what) {
    refuse_(offset, what);
    lost_ = true;
    lost_at_ = offset;
}

void RawStream::skipped(std::uint64_t end) {
    refuse_(lost_at_, counted(end - lost_at_, "byte") + " skipped: no message begins there");
}

void decode_record(const TypeSet& types, std::string_view record, const RawStream::Decode& decode,
                   bool lenient) {
    std::size_t taken = decode(record);
    std::string_view rest = record.substr(taken);
    while (!rest.empty() && !types.is_padding(rest)) {
        try {
            if (taken == 0) throw DataError("the message takes no bytes");
            taken = decode(rest);
            rest.remove_prefix(taken);
        } catch (const DataError& e) {
            if (lenient) return;
            throw DataError(counted(rest.size(), "byte") +
                            (rest.size() == 1 ? " is left over: " : " are left over: ") + e.what());
        }
    }
}

}  // namespace seautils::dccl
