#include "seautils/record/duplicates.hpp"

namespace seautils::record {

Duplicates::Duplicates(std::int64_t window_ns, std::size_t most)
    : window_ns_(window_ns), most_(most) {}

bool Duplicates::is_again(std::uint32_t src, std::string_view bytes, std::int64_t time_ns) {
    std::string key = std::to_string(src) + ' ';
    key += bytes;
    forget(time_ns - window_ns_);
    const auto [at, is_new] = last_.try_emplace(key, time_ns);
    at->second = time_ns;
    in_order_.emplace_back(time_ns, std::move(key));
    return !is_new;
}

void Duplicates::forget(std::int64_t before_ns) {
    while (!in_order_.empty() &&
           (in_order_.front().first < before_ns || in_order_.size() >= most_)) {
        const auto& [time_ns, key] = in_order_.front();
        const auto found = last_.find(key);
        if (found != last_.end() && found->second == time_ns) last_.erase(found);
        in_order_.pop_front();
    }
}

}  // namespace seautils::record
