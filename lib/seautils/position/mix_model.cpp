#include "seautils/position/mix_model.hpp"

#include <algorithm>

namespace seautils::position {

namespace {

std::size_t level(std::int64_t v, std::initializer_list<std::int32_t> bounds) {
    std::size_t n = 0;
    for (const std::int32_t b : bounds) n += (v < 0 ? -v : v) >= b ? 1U : 0U;
    return n;
}

std::size_t age(std::uint32_t known) { return known < 4 ? 0 : known < 12 ? 1 : 2; }

std::int32_t scored(std::int32_t score, std::int32_t probability_q24) {
    const std::int32_t log = log2_q16(static_cast<std::uint64_t>(probability_q24) + 1) - (24 << 16);
    return static_cast<std::int32_t>((std::int64_t{score} * 230 >> 8) + log);
}

}  // namespace

MixModel::MixModel(std::size_t capacity, const std::vector<Cell>& plan)
    : path_(AnalogModel::Kind::path, capacity),
      innovation_(AnalogModel::Kind::innovation, capacity),
      world_(AnalogModel::Kind::world, capacity),
      place_(AnalogModel::Kind::place, capacity),
      cases_(capacity),
      plan_(plan),
      plane_mixer_(planes + (plan.empty() ? 0 : 1), {12, 15, 9}),
      depth_mixer_(depths + (plan.empty() ? 0 : 1), {1, 4, 15}) {}

void MixModel::widen(std::int64_t times) {
    for (FilterModel* m : {&slow_, &fast_}) m->widen(times * times);
    for (AnalogModel* m : {&path_, &innovation_, &world_, &place_}) m->widen(times * times);
    for (DepthModel* m : {&slow_z_, &fast_z_, &hold_z_}) m->widen(times);
    cases_.widen(times);
}

Mixer::Contexts MixModel::plane_contexts(const Motion& m) {
    const std::size_t surprise = level(length(m.innovation[0]), {128, 256, 512, 1280});
    return {m.turn_context(), surprise * 3 + age(m.known),
            level(m.innovation_z, {128, 384}) * 3 + age(m.known)};
}

Mixer::Contexts MixModel::depth_contexts(const Motion& m) {
    const std::size_t moving = m.sunk[0] != 0 || m.sunk[1] != 0 ? 1 : 0;
    return {0, moving * 2 + (m.since_dive < 3 ? 0 : 1),
            level(m.innovation_z, {64, 160, 384, 1024}) * 3 + age(m.known)};
}

void MixModel::forecast(const Motion& m, Forecast& f) {
    f.slow = m.expected(m.slow);
    f.fast = m.expected(m.fast);
    f.slow_z = m.expected(m.slow_z);
    f.fast_z = m.expected(m.fast_z);
    f.plane = {slow_.predict(m, f.slow), fast_.predict(m, f.fast), turn_.predict(m),
               path_.predict(m),         innovation_.predict(m),   world_.predict(m),
               place_.predict(m),        plan_.predict(m)};
    f.depth = {slow_z_.predict(f.slow_z), fast_z_.predict(f.fast_z), hold_z_.predict(0),
               cases_.predict(m), plan_.predict_depth(m)};
}

ValueCoder MixModel::z_coder(const Motion& m, const Forecast& f) {
    const auto best = static_cast<std::size_t>(
        std::max_element(depth_score_.begin(), depth_score_.end()) - depth_score_.begin());
    const std::array<std::int32_t, 3> means{f.slow_z, f.fast_z, 0};
    ValueCoder coder(means[best], depth_mixer_, depth_contexts(m));
    for (std::size_t k = 0; k + (plan_.empty() ? 1 : 0) < depths; ++k) coder.add(f.depth[k]);
    return coder;
}

ValueCoder MixModel::coder_of(const std::array<Mixture, planes>& models, const Motion& m) {
    const std::size_t best = plane_score_[1] > plane_score_[0] ? 1 : 0;
    ValueCoder coder(models[best].mean(), plane_mixer_, plane_contexts(m));
    for (std::size_t k = 0; k < plane_count(); ++k) coder.add(models[k]);
    return coder;
}

ValueCoder MixModel::x_coder(const Motion& m, Forecast& f) {
    for (std::size_t k = 0; k < plane_count(); ++k) f.along_x[k] = f.plane[k].along_x();
    return coder_of(f.along_x, m);
}

ValueCoder MixModel::y_coder(const Motion& m, Forecast& f, std::int32_t step_x) {
    for (std::size_t k = 0; k < plane_count(); ++k) f.along_y[k] = f.plane[k].along_y(step_x);
    return coder_of(f.along_y, m);
}

void MixModel::learn(const Motion& m, const Forecast& f, const Cell& step) {
    for (std::size_t k = 0; k < plane_score_.size(); ++k)
        plane_score_[k] = scored(plane_score_[k], f.plane[k].probability_q24(step.x, step.y));
    for (std::size_t k = 0; k < depth_score_.size(); ++k)
        depth_score_[k] = scored(depth_score_[k], f.depth[k].probability_q24(step.z));
    slow_.learn(m, f.slow, f.plane[0], step);
    fast_.learn(m, f.fast, f.plane[1], step);
    turn_.learn(m, f.plane[2], step);
    path_.learn(m, f.plane[3], step);
    innovation_.learn(m, f.plane[4], step);
    world_.learn(m, f.plane[5], step);
    place_.learn(m, f.plane[6], step);
    slow_z_.learn(f.slow_z, f.depth[0], step.z);
    fast_z_.learn(f.fast_z, f.depth[1], step.z);
    hold_z_.learn(0, f.depth[2], step.z);
    cases_.learn(m, f.depth[3], step.z);
    plan_.learn(m, f.plane[7], f.depth[4], step);
}

}  // namespace seautils::position
