#include "seautils/dccl/dynamic.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seautils::dccl {

namespace {

/// The rule of static bounds: on the grid, where the schema says `resolution`.
void check_grid(const Op& op, double bound) {
    const NumberCode& n = op.number;
    if (std::fabs(quantize(bound, n.resolution, n.inverse) - bound) < 1e-10) return;
    if (!field_options(*op.field->descriptor).resolution) return;
    throw DataError(
        fmt::format("dynamic bound {} is no multiple of resolution {}", bound, n.resolution));
}

}  // namespace

bool Dynamic::test(const std::string& script, const Frame& self) {
    return engine_.test(script, values_, root(), {self.layout, self.block}, self.index);
}

bool Dynamic::omitted(const Op& op, const Frame& self) {
    const ConditionCode& c = program_.conditions(op);
    if (!c.asks_omit) return false;
    if (!c.scripts.omit_if.empty()) return test(c.scripts.omit_if, self);
    return !test(c.scripts.only_if, self);
}

Op Dynamic::effective(const Op& op, const Frame& self) {
    const ConditionCode& c = program_.conditions(op);
    Op result = op;
    NumberCode& n = result.number;
    bool changed = false;
    if (c.asks_required && op.kind != OpKind::message && !op.repeated) {
        const std::string& script =
            c.scripts.required_if.empty() ? c.scripts.only_if : c.scripts.required_if;
        if (test(script, self)) {
            result.presence_bit = false;
            changed = n.null_code;
            n.null_code = false;
        }
    }
    if (op.kind == OpKind::boolean) {
        n.width = n.null_code ? 2 : 1;
        result.element_min_bits = n.width;
        return result;
    }
    double min = n.min;
    double max = n.max;
    if (c.asks_bounds && (op.kind == OpKind::integer || op.kind == OpKind::floating)) {
        const auto bound = [&](const std::string& script, double otherwise) {
            if (script.empty()) return otherwise;
            const auto value =
                engine_.number(script, values_, root(), {self.layout, self.block}, self.index);
            return value ? std::min(n.max, std::max(*value, n.min)) : otherwise;
        };
        min = bound(c.scripts.min, n.min);
        max = bound(c.scripts.max, n.max);
        check_grid(op, min);
        check_grid(op, max);
        changed = true;
    }
    if (!changed) return result;
    if (!(min <= max)) {
        throw DataError(fmt::format("dynamic bounds {} and {} enclose nothing", min, max));
    }
    n = make_number_code(n.kind, min, max, n.resolution, !n.null_code);
    result.element_min_bits = n.width;
    return result;
}

}  // namespace seautils::dccl
