// The inputs of tl-model, one after another: environment files, and streams of requests.
#ifndef SEAUTILS_TOOLS_TL_SESSION_HPP
#define SEAUTILS_TOOLS_TL_SESSION_HPP

#include "record_form.hpp"
#include "tl_answer.hpp"
#include "tl_options.hpp"
#include "tl_plot.hpp"
#include "tl_request.hpp"
#include "tl_schema.hpp"
#include "tl_toolbox.hpp"
#include "tl_workers.hpp"

#include "seautils/cli/io.hpp"
#include "seautils/cli/loop.hpp"
#include "seautils/core/error.hpp"
#include "seautils/propagation/case_file.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/stream/whole_file.hpp"
#include "seautils/toolbox/env_file.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seautils::tools {

class TlSession {
public:
    TlSession(cli::Io& io, const TlOptions& options)
        : io_(io), options_(options), computer_(options.external()) {}

    void run() {
        std::vector<std::string> files = io_.files;
        if (files.empty()) files = {"-"};
        for (const std::string& file : files) {
            if (io_.ended_by != 0) return;
            const std::string form = form_of(file);
            if (form == "case" || form == "env")
                answer_file(file, form);
            else
                answer_requests(file, form);
        }
        if (last_) TlPlot::draw(options_.picture(), *last_, options_.rays());
    }

private:
    static constexpr std::size_t most_bytes = std::size_t{1} << 26;

    std::string form_of(const std::string& file) const {
        if (io_.input_format != "auto") return io_.input_format;
        if (file.ends_with(".json")) return "case";
        if (file.ends_with(".env")) return "env";
        return "ndjson";
    }

    /// All bytes of a file. @throws Error(no_input)
    std::string content_of(const std::string& file) {
        std::string all;
        if (file == "-") {
            io_.files = {file};
            io_.for_each_block([&](std::string_view bytes, std::uint64_t, bool) {
                if (all.size() < most_bytes) all += bytes;
                return bytes.size();
            });
        } else {
            auto text = stream::read_whole_file(file, most_bytes);
            if (!text) throw Error(ExitCode::no_input, file + ": No such file or directory");
            all = std::move(*text);
        }
        if (all.size() >= most_bytes)
            throw DataError(fmt::format("is not shorter than {} bytes", most_bytes));
        return all;
    }

    /// What a file asks for: a task for each source. @throws DataError, Error(no_input)
    std::vector<TlTask> read_tasks(const std::string& file, const std::string& form) {
        TlTask task;
        std::vector<double> source_depth_m;
        std::vector<std::string> remarks;
        if (form == "case") {
            pg::Case c = pg::read_case(content_of(file));
            task.environment = std::move(c.environment);
            task.arrivals_at = std::move(c.arrivals);
            remarks = std::move(c.remarks);
        } else {
            toolbox::EnvFile env = toolbox::read_env(content_of(file), beside(file));
            task.environment = std::move(env.environment);
            task.options = env.options;
            task.engine = env.engine;
            task.arrivals = env.arrivals;
            task.loss = !env.arrivals;
            source_depth_m = std::move(env.source_depth_m);
            remarks = std::move(env.remarks);
        }
        for (const std::string& remark : remarks) io_.warn(name_of(file) + ": " + remark);
        options_.apply(task);
        std::vector<TlTask> tasks(std::max<std::size_t>(source_depth_m.size(), 1), task);
        for (std::size_t k = 0; k < source_depth_m.size(); ++k)
            tasks[k].environment.source.depth_m = source_depth_m[k];
        return tasks;
    }

    /// Files of the same name with another extension.
    static toolbox::Companion beside(const std::string& file) {
        const std::string root = file.substr(0, file.size() - (file.ends_with(".env") ? 4 : 0));
        return [root](const std::string& extension) {
            std::optional<std::string> text =
                stream::read_whole_file(root + "." + extension, most_bytes);
            if (text && text->size() >= most_bytes)
                throw DataError(fmt::format("the .{} file is not shorter than {} bytes", extension,
                                            most_bytes));
            return text;
        };
    }

    static std::string name_of(const std::string& file) { return file == "-" ? "<stdin>" : file; }

    bool is_toolbox_file() const {
        return io_.format == "shd" || io_.format == "arr" || io_.format == "arr-binary";
    }

    void answer_file(const std::string& file, const std::string& form) {
        try {
            std::vector<TlResult> results;
            for (TlTask& task : read_tasks(file, form)) {
                if (io_.format == "shd" || io_.format == "csv") want(task, true);
                if (io_.format.starts_with("arr")) want(task, false);
                results.push_back(computer_.compute(std::make_shared<TlTask>(std::move(task))));
                if (!results.back().error.empty()) throw DataError(results.back().error);
                for (const std::string& remark : results.back().field.basis.remarks)
                    io_.inform(name_of(file) + ": " + remark);
                if (options_.picture().is_wanted()) last_ = results.back();
                if (is_toolbox_file()) continue;
                write(results.back());
                results.pop_back();
            }
            if (is_toolbox_file()) write_toolbox_file(results);
        } catch (const DataError& e) {
            io_.refuse(name_of(file) + ": ", e.what());
        }
    }

    /// The format says whether losses or arrivals are wanted. @throws Error(usage)  --arrivals says otherwise
    void want(TlTask& task, bool losses) const {
        if (losses && options_.arrivals)
            throw Error(ExitCode::usage,
                        "option --arrivals: format " + io_.format + " holds losses");
        task.loss = losses;
        task.arrivals = !losses;
    }

    void write_toolbox_file(const std::vector<TlResult>& results) {
        if (io_.format == "shd")
            io_.out << write_shd(shd_of(results), options_.shd_layout());
        else
            io_.out << write_arr(arr_of(results), io_.format == "arr" ? toolbox::ArrForm::text
                                                                      : toolbox::ArrForm::binary);
    }

    TlKnown first_known() {
        if (options_.base.empty()) {
            TlTask task;
            options_.apply(task);
            return {std::move(task), false};
        }
        const bool is_env = options_.base.ends_with(".env");
        try {
            return {read_tasks(options_.base, is_env ? "env" : "case").front(), true};
        } catch (const DataError& e) {
            throw ConfigError(options_.base + ": " + e.what());
        }
    }

    void answer_requests(const std::string& file, const std::string& form) {
        if (is_toolbox_file())
            throw Error(ExitCode::usage,
                        "option --format: " + io_.format + " is for CASE.json and .env files");
        if (!known_) known_ = first_known();
        io_.files = {file};
        TlWorkers workers(options_.jobs(), options_.external());
        cli::Loop loop(io_);
        const bool binary = form == "delimited";
        loop.inputs(binary ? cli::Framing::delimited : cli::Framing::lines,
                    [&](std::string_view bytes) { answer(bytes, binary, loop.place(), workers); });
        loop.before_wait([&] { write_pending(workers, 0); });
        loop.run();
        write_pending(workers, 0);
    }

    /// What is wrong with a request is its answer, and nothing of it counts.
    void answer(std::string_view bytes, bool binary, std::string place, TlWorkers& workers) {
        TlResult result;
        TlKnown before = *known_;
        auto task = std::make_shared<TlTask>();
        try {
            if (binary)
                schema::read_binary(bytes, schema_.request(), values_);
            else
                json_.read(bytes, schema_.request(), values_);
            const schema::Slot& id = values_[field::request::id];
            if (id.present) task->id = static_cast<std::uint32_t>(id.u);
            known_->merge(values_);
            *task = known_->task();
            if (task->loss || task->arrivals) pg::check(task->environment);
        } catch (const DataError& e) {
            known_ = std::move(before);
            result.error = in_words_of_requests(e.what());
        }
        task->place = std::move(place);
        result.task = std::move(task);
        workers.post(std::move(result));
        write_pending(workers, workers.most_pending());
    }

    void write_pending(TlWorkers& workers, std::size_t most) {
        while (workers.pending() > most || workers.is_ready()) write(workers.take());
    }

    void write(const TlResult& result) {
        if (options_.picture().is_wanted() && result.error.empty()) last_ = result;
        std::string& out = io_.out.buffer();
        if (io_.format == "csv") {
            if (result.error.empty() && result.task->loss)
                append_csv(result.task->environment.receivers, result.field.loss_db, out);
        } else if (io_.format == "ndjson" && options_.arrivals && result.error.empty()) {
            const TlArrivalLines lines(result.task->environment.frequency_hz);
            for (const pg::ReceiverArrivals& receiver : result.arrivals) {
                lines.append(receiver, out);
                io_.out.commit();
            }
        } else {
            append_record(writer_.put(result), io_.format, out);
        }
        io_.out.commit();
        if (!result.error.empty()) io_.refuse(result.task->place, result.error);
    }

    cli::Io& io_;
    const TlOptions& options_;
    std::optional<TlKnown> known_;
    std::optional<TlResult> last_;  ///< for the picture
    TlComputer computer_;
    TlSchema schema_;
    schema::JsonReader json_;
    schema::Values values_;
    TlAnswerWriter writer_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_SESSION_HPP
