// Where depth-plan has its losses from: files, answers in its input, or a model that it asks.
#ifndef SEAUTILS_TOOLS_DEPTH_SEA_HPP
#define SEAUTILS_TOOLS_DEPTH_SEA_HPP

#include "depth_partner.hpp"
#include "depth_schema.hpp"

#include "seautils/plan/loss_csv.hpp"
#include "seautils/plan/loss_field.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/number_text.hpp"
#include "seautils/stream/whole_file.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::tools {

/// Reads what tl-model answers.
class AnswerReader {
public:
    /// @throws DataError  no answer, one that says an error, or no field
    plan::LossField read(std::string_view json, std::optional<std::uint32_t> id = {}) {
        namespace a = field::loss_answer;
        reader_.read(json, schema_.answer(), values_, schema::Unknown::skip);
        if (values_[a::error].present)
            throw DataError(printable(values_.text(values_[a::error]), 500));
        if (id && (!values_[a::id].present || values_[a::id].u != *id))
            throw DataError("it answered something that was not asked");
        plan::LossField field{
            .depth_m = list(a::depth_m), .range_m = list(a::range_m), .loss_db = {}};
        for (const double h : list(a::tl_db)) field.loss_db.push_back(static_cast<float>(h));
        check(field);
        return field;
    }

private:
    std::vector<double> list(std::uint32_t f) const {
        std::vector<double> all;
        const schema::Slot& slot = values_[f];
        for (std::uint32_t k = 0; slot.present && k < slot.aux; ++k)
            all.push_back(values_[static_cast<std::uint32_t>(slot.u) + k].d);
        return all;
    }

    DepthSchema schema_;
    schema::JsonReader reader_;
    schema::Values values_;
};

/// A field from a file: a table, or an answer of tl-model. @throws Error  located
inline plan::LossField read_loss_file(const std::string& file) {
    constexpr std::size_t most_bytes = 64U << 20;
    const std::string text = stream::read_input_file(file, most_bytes);
    try {
        if (!text.starts_with('{')) return plan::read_loss_csv(text);
        return AnswerReader().read(std::string_view(text).substr(0, text.find('\n')));
    } catch (const DataError& e) {
        const bool has_line = e.what()[0] >= '0' && e.what()[0] <= '9';
        throw Error(ExitCode::data, file + (has_line ? ":" : ": ") + e.what());
    }
}

/// What losses are needed for.
struct SeaNeed {
    plan::RangeWindow window;
    double margin_m = 0;  ///< asked for beyond the window, so that the next one is there too
    double range_step_m = 10, depth_step_m = 1;
    std::optional<double> source_depth_m, water_depth_m;
};

class DepthSea {
public:
    struct Options {
        std::vector<std::string> files;
        std::string model;
        double timeout_s = 10;
        std::size_t instances = 1;
    };

    /// @throws Error  a file cannot be read
    explicit DepthSea(const Options& options) : options_(options) {
        for (const std::string& file : options.files) fields_.push_back(read_loss_file(file));
        if (!options.model.empty())
            partner_ = std::make_unique<Partner>(options.model, options.timeout_s);
    }

    const std::vector<plan::LossField>& fields() const { return fields_; }
    bool is_stale() const { return stale_; }

    /// A line that is an answer of tl-model. @throws DataError
    void take_answer(std::string_view line) { keep(reader_.read(line)); }

    /// A line that is a SoundSpeedProfile: the model's, from now on.
    void take_profile(std::string_view line) {
        if (!partner_) return;
        profiles_.emplace_back(line);
        if (profiles_.size() > options_.instances) profiles_.pop_front();
        asked_.reset();
    }

    /// Asks the model where what is there is not enough.
    /// @throws DataError  it does not answer; what was there stays, and is stale
    void provide(const SeaNeed& need, std::int64_t now_ns) {
        if (!partner_ || is_enough(need)) return;
        stale_ = !fields_.empty();
        if (is_waiting(now_ns)) return;
        try {
            ask_all(need);
            stale_ = false;
            pause_ns_ = first_pause_ns;
            failed_ns_.reset();
        } catch (const DataError&) {
            pause_ns_ = failed_ns_ ? std::min(2 * pause_ns_, longest_pause_ns) : first_pause_ns;
            failed_ns_ = now_ns;
            throw;
        }
    }

private:
    static constexpr std::int64_t first_pause_ns = 1'000'000'000, longest_pause_ns = 64'000'000'000;
    static constexpr double most_cells = 100'000;

    void keep(plan::LossField field) {
        fields_.push_back(std::move(field));
        while (fields_.size() > options_.instances) fields_.erase(fields_.begin());
        stale_ = false;
    }

    /// After a failure the model is left alone for a while, that grows.
    bool is_waiting(std::int64_t now_ns) const {
        return failed_ns_ && now_ns >= *failed_ns_ && now_ns - *failed_ns_ < pause_ns_;
    }

    bool is_enough(const SeaNeed& need) const {
        if (!asked_ || fields_.empty()) return false;
        const auto near = [](std::optional<double> a, std::optional<double> b, double part) {
            if (!a || !b) return a.has_value() == b.has_value();
            return std::abs(*a - *b) <= std::max(1.0, part * *b);
        };
        return need.window.from_m >= asked_->window.from_m &&
               need.window.to_m <= asked_->window.to_m &&
               near(need.source_depth_m, asked_->source_depth_m, 0.01) &&
               near(need.water_depth_m, asked_->water_depth_m, 0.02);
    }

    void ask_all(const SeaNeed& need) {
        SeaNeed wide = need;
        wide.window.from_m = std::max(need.window.from_m - need.margin_m, 0.0);
        wide.window.to_m = need.window.to_m + need.margin_m;
        std::vector<plan::LossField> fields;
        for (std::size_t k = 0; k < std::max<std::size_t>(profiles_.size(), 1); ++k)
            fields.push_back(ask(wide, k < profiles_.size() ? profiles_[k] : ""));
        fields_ = std::move(fields);
        asked_ = wide;
    }

    plan::LossField ask(const SeaNeed& need, const std::string& profile) {
        ++id_;
        std::string line = fmt::format("{{\"id\":{}", id_);
        if (need.source_depth_m) {
            line += ",\"source\":{\"depth_m\":";
            schema::append_double(line, *need.source_depth_m);
            line += '}';
        }
        append_receivers(line, need);
        if (need.water_depth_m) {
            line += ",\"bottom_depth_m\":";
            schema::append_double(line, *need.water_depth_m);
        }
        if (!profile.empty()) line += ",\"profile\":" + profile;
        const std::string answer = partner_->ask(line + ",\"loss\":true,\"arrivals\":false}");
        try {
            return reader_.read(answer, id_);
        } catch (const DataError& e) {
            throw DataError(fmt::format("model {}: {}", quote(options_.model), e.what()));
        }
    }

    /// Ranges are whole steps: those that a model has computed before come again.
    static void append_receivers(std::string& line, const SeaNeed& need) {
        const double step = need.range_step_m;
        const double first = std::max(std::floor(need.window.from_m / step), 1.0);
        const double last = std::max(std::ceil(need.window.to_m / step), first + 1);
        const double first_m = first * step, last_m = last * step;
        const double ranges = std::min(last - first + 1, 2000.0);
        line += ",\"receivers\":{\"ranges\":";
        append_span(line, first_m, last_m, ranges);
        if (need.water_depth_m && *need.water_depth_m > 2 * need.depth_step_m) {
            const double depths =
                std::min(std::floor(*need.water_depth_m / need.depth_step_m), most_cells / ranges);
            line += ",\"depths\":";
            const double step_m = *need.water_depth_m / (std::floor(depths) + 1);
            append_span(line, step_m, step_m * std::floor(depths), std::floor(depths));
        }
        line += '}';
    }

    static void append_span(std::string& line, double first_m, double last_m, double count) {
        line += "{\"start_m\":";
        schema::append_double(line, first_m);
        line += ",\"stop_m\":";
        schema::append_double(line, last_m);
        line += fmt::format(",\"count\":{:.0f}}}", count);
    }

    Options options_;
    std::unique_ptr<Partner> partner_;
    AnswerReader reader_;
    std::vector<plan::LossField> fields_;
    std::deque<std::string> profiles_;
    std::optional<SeaNeed> asked_;  ///< nothing: ask
    std::uint32_t id_ = 0;
    bool stale_ = false;
    std::optional<std::int64_t> failed_ns_;
    std::int64_t pause_ns_ = first_pause_ns;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_SEA_HPP
