// How ssp reads casts, and makes profiles of them.
#ifndef SEAUTILS_TOOLS_SSP_CASTS_HPP
#define SEAUTILS_TOOLS_SSP_CASTS_HPP

#include "record_form.hpp"
#include "ssp_options.hpp"
#include "ssp_records.hpp"

#include "seautils/acoustics/cnv.hpp"
#include "seautils/cli/loop.hpp"
#include "seautils/stream/whole_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::tools {

/// Scans of one file, in whatever form they come; the form is told by the first line unless it is said.
class ScanReader {
public:
    enum class Form : std::uint8_t { unknown, csv, cnv, json, binary, none };

    ScanReader(const std::string& format, const std::vector<acoustics::NamedColumn>& columns)
        : csv_(columns) {
        if (format == "csv") form_ = Form::csv;
        if (format == "cnv") form_ = Form::cnv;
        if (format == "ndjson") form_ = Form::json;
        if (format == "delimited") form_ = Form::binary;
    }

    /// Calls `scan` for each scan of a line or record. @throws DataError
    template <class Scan>
    void read(std::string_view bytes, Scan scan) {
        if (first_ && bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
        if (form_ == Form::unknown) form_ = tell(bytes);
        first_ = false;
        if (form_ == Form::json || form_ == Form::binary)
            return records_.read(bytes, form_ == Form::json, scan);
        acoustics::Reading reading;
        if (form_ == Form::csv && csv_.read(bytes, reading)) scan(reading);
        if (form_ == Form::cnv && cnv_.read(bytes, reading)) scan(reading);
    }

    /// Whether samples may come one by one, as they are measured.
    bool is_records() const { return form_ == Form::json || form_ == Form::binary; }

private:
    Form tell(std::string_view line) {
        if (line.starts_with("\x1F\x8B")) {
            form_ = Form::none;
            throw DataError("compressed by gzip (zcat FILE | ssp)");
        }
        const std::string_view text = acoustics::trim(line);
        if (text.starts_with('{')) return Form::json;
        return text.starts_with('*') ? Form::cnv : Form::csv;
    }

    Form form_ = Form::unknown;
    bool first_ = true;
    acoustics::CtdCsv csv_;
    acoustics::Cnv cnv_;
    SampleReader records_;
};

/// The profile of a whole file that is no part of the stream.
/// @throws Error  cannot be read, or `FILE:LINE: what` of its first fault
inline acoustics::Profile read_climatology(const SspOptions& options) {
    constexpr std::size_t most_bytes = 64U << 20;
    const std::string& file = options.climatology;
    const std::string text = stream::read_input_file(file, most_bytes);
    ScanReader reader("auto", options.columns);
    std::vector<acoustics::Sample> samples;
    std::string_view rest = text;
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        try {
            reader.read(acoustics::trim(rest.substr(0, end)),
                        [&](const acoustics::Reading& reading) {
                            acoustics::Sample sample;
                            if (reduce(reading, options.reduction, sample) == acoustics::Drop::none)
                                samples.push_back(sample);
                        });
        } catch (const DataError& e) {
            throw Error(ExitCode::data, fmt::format("{}:{}: {}", file, line, e.what()));
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    acoustics::Binning as_it_is = options.binning;
    as_it_is.cleaning = {.spike_deviations = 0, .loop_m = 0};
    acoustics::Profile profile = acoustics::bin_samples(samples, as_it_is);
    if (profile.levels.empty()) throw Error(ExitCode::data, file + ": holds no profile");
    return profile;
}

/// Casts in, profiles out.
class SspCasts {
public:
    SspCasts(cli::Io& io, const SspOptions& options)
        : io_(io),
          options_(options),
          windows_(options.windowing,
                   [this](auto samples, auto direction) { write_or_refuse(samples, direction); }) {
        if (!options.climatology.empty()) climatology_ = read_climatology(options);
        extending_ = options.extending;
        if (climatology_ && options.to_end_of_climatology)
            extending_.to_m = climatology_->levels.back().depth_m;
        struct stat status {};
        is_live_ = ::fstat(STDIN_FILENO, &status) == 0 && !S_ISREG(status.st_mode);
    }

    /// Each file is a cast, or a stream, of its own.
    void run() {
        const std::vector<std::string> files =
            io_.files.empty() ? std::vector<std::string>{"-"} : io_.files;
        for (const std::string& file : files)
            if (io_.ended_by == 0) run(file);
    }

private:
    void run(const std::string& file) {
        name_ = file == "-" ? "<stdin>" : file;
        reader_ = std::make_unique<ScanReader>(io_.input_format, options_.columns);
        counts_ = total_ = {};
        latitude_deg_ = longitude_deg_ = acoustics::not_available;
        written_ = said_ = 0;
        io_.files = {file};
        const bool binary = io_.input_format == "delimited";
        read(binary ? cli::Framing::delimited : cli::Framing::lines,
             [this](std::string_view bytes) {
                 reader_->read(bytes, [this](acoustics::Reading& reading) { take(reading); });
             });
        windows_.end();
        const std::uint64_t scans = total_.dropped() + total_[acoustics::Drop::none];
        if (written_ == 0 && scans > 0)
            io_.refuse(name_ + ": ", "no profile: " + counted(scans, "scan") + " left out (" +
                                         reasons(total_) + ")");
    }

    void read(cli::Framing framing, const std::function<void(std::string_view)>& record) {
        if (options_.silence_ns == 0) return io_.for_each(framing, record);
        loop_.emplace(io_);
        loop_->inputs(framing, record);
        loop_->on_wake([this] { windows_.end(); });
        loop_->run();
        loop_.reset();
    }

    /// Silence is counted from the last sample that counts; by the clock of the input from its time.
    void await_silence() {
        const std::int64_t now = io_.clock.steady_ns();
        if (loop_ && now > 0) loop_->wake_at_steady(now + options_.silence_ns);
    }

    void advance(std::int64_t time_ns) {
        if (loop_) return loop_->advance(time_ns);
        io_.clock.advance(time_ns);
    }

    void take(acoustics::Reading& reading) {
        reading.line = loop_ ? loop_->record_number() : io_.record_number();
        set_time(reading);
        const double latitude = reading[acoustics::Quantity::latitude_deg];
        const double longitude = reading[acoustics::Quantity::longitude_deg];
        acoustics::Sample sample;
        std::string why;
        const acoustics::Drop drop =
            reduce(reading, options_.reduction, sample, io_.verbosity > 0 ? &why : nullptr);
        ++total_[drop];
        if (drop != acoustics::Drop::none) {
            ++counts_[drop];
            return say(reading.line, drop, why);
        }
        if (!std::isnan(latitude)) latitude_deg_ = latitude;
        if (!std::isnan(longitude)) longitude_deg_ = longitude;
        await_silence();
        windows_.add(sample);
    }

    /// Samples that come one by one without a time are of now, and those of a replay of then.
    void set_time(acoustics::Reading& reading) {
        if (reading.time_ns != acoustics::no_time) return advance(reading.time_ns);
        if (!reader_->is_records() || !(is_live_ || io_.clock.is_input())) return;
        const std::int64_t now = io_.clock.now_ns();
        if (now > 0) reading.time_ns = now;
    }

    void say(std::uint64_t line, acoustics::Drop drop, const std::string& why) {
        if (io_.verbosity <= 0) return;
        io_.inform(fmt::format("{}:{}: left out ({}){}{}", name_, line, name(drop),
                               why.empty() ? "" : ": ", why));
    }

    /// Each is said once, though windows may overlap.
    void say_all(std::span<const acoustics::Sample> samples,
                 const std::vector<acoustics::Drop>& why) {
        std::uint64_t newest = said_;
        for (std::size_t k = 0; k < samples.size() && io_.verbosity > 0; ++k) {
            if (samples[k].line <= said_) continue;
            newest = samples[k].line;
            if (why[k] != acoustics::Drop::none) say(samples[k].line, why[k], "");
        }
        said_ = newest;
    }

    static std::string reasons(const acoustics::DropCounts& counts) {
        std::string all;
        for (std::size_t k = 1; k < acoustics::drops; ++k) {
            if (counts.count[k] == 0) continue;
            all += fmt::format("{}{} {}", all.empty() ? "" : ", ", counts.count[k],
                               name(static_cast<acoustics::Drop>(k)));
        }
        return all;
    }

    /// A profile that cannot be made is refused, and the next one is.
    void write_or_refuse(std::span<const acoustics::Sample> samples,
                         acoustics::Direction direction) {
        try {
            write(samples, direction);
        } catch (const DataError& e) {
            ++written_;  // at least it was said
            io_.refuse(name_ + ": ", e.what());
        }
    }

    void write(std::span<const acoustics::Sample> samples, acoustics::Direction direction) {
        std::vector<acoustics::Drop> why;
        acoustics::Profile profile = acoustics::bin_samples(samples, options_.binning, &why);
        say_all(samples, why);
        profile.dropped += counts_;
        counts_ = {};
        profile.direction = direction;
        if (!std::isnan(latitude_deg_)) profile.latitude_deg = latitude_deg_;
        if (std::isnan(latitude_deg_) && options_.reduction.latitude_deg)
            profile.latitude_deg = options_.reduction.latitude_deg;
        if (!std::isnan(longitude_deg_)) profile.longitude_deg = longitude_deg_;
        if (profile.levels.empty()) return;
        if (options_.extends)
            climatology_ ? extend_by(profile, *climatology_, extending_)
                         : extend_isothermal(profile, extending_);
        ++written_;
        put(profile);
        io_.inform(fmt::format(
            "{}: profile of {} of {}, {}", name_, counted(profile.levels.size(), "level"),
            counted(profile.dropped[acoustics::Drop::none], "sample"),
            profile.dropped.dropped() == 0 ? "none left out"
                                           : "left out " + reasons(profile.dropped)));
    }

    void put(const acoustics::Profile& profile) {
        if (io_.format == "csv") {
            csv_.write(profile, io_.out.buffer());
            return io_.out.commit();
        }
        append_record(writer_.put(profile, name_ == "<stdin>" ? "" : name_), io_.format,
                      io_.out.buffer());
        io_.out.commit();
    }

    cli::Io& io_;
    const SspOptions& options_;
    acoustics::Windows windows_;
    acoustics::Extending extending_;
    std::optional<acoustics::Profile> climatology_;
    std::unique_ptr<ScanReader> reader_;
    std::optional<cli::Loop> loop_;  ///< where silence is waited for
    ProfileWriter writer_;
    ProfileCsv csv_;
    std::string name_;
    acoustics::DropCounts counts_, total_;  ///< since the last profile; of the file
    double latitude_deg_ = acoustics::not_available, longitude_deg_ = acoustics::not_available;
    std::uint64_t written_ = 0, said_ = 0;
    bool is_live_ = false;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_SSP_CASTS_HPP
