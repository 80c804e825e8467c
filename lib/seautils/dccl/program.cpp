#include "seautils/dccl/program.hpp"

#include "seautils/dccl/compiler.hpp"
#include "seautils/dccl/hash.hpp"

namespace seautils::dccl {

namespace {

std::uint64_t bytes_of(std::uint64_t bits) { return (bits + 7) / 8; }

}  // namespace

std::shared_ptr<const Program> Program::compile(const schema::Layout& layout,
                                                const ProgramOptions& options) {
    return Compiler(layout, options).run();
}

std::uint64_t Program::largest_bytes() const {
    return bytes_of(id_bits_ + head_max_) + bytes_of(body_max_);
}
std::uint64_t Program::smallest_bytes() const {
    return bytes_of(id_bits_ + head_min_) + bytes_of(body_min_);
}
std::uint64_t Program::reported_max_size() const {
    const unsigned id = omit_id_ ? 0 : id_codec_ == IdCodec::ccl ? 24 : 16;
    return bytes_of(id + head_max_) + bytes_of(body_max_);
}
std::uint64_t Program::reported_min_size() const {
    return bytes_of((omit_id_ ? 0 : 8) + head_min_) + bytes_of(body_min_);
}
std::uint64_t Program::definition_hash() const { return hash_definition(*this); }

std::vector<FieldReport> Program::report() const { return report_; }

}  // namespace seautils::dccl
