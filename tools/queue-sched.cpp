// queue-sched - say which messages are worth sending in each turn
#include "queue_desk.hpp"

#include <csignal>

using namespace seautils;

namespace {

constexpr std::int64_t longest_wait_s = 1'000'000;

/// CLI11 wants what is wrong, or nothing.
std::string is_policy(const std::string& name) {
    return queue::parse_policy(name) ? ""
                                     : quote(name) + " is none of priority, value, ttl, oldest";
}

std::string is_wait(const std::string& text) {
    const auto ns = queue::parse_decimal(text, 9);
    if (ns && *ns <= longest_wait_s * queue::QueueConfig::ns_per_s) return "";
    return quote(text) + " is outside 0 to 1000000 s";
}

auto is_within(std::int64_t least, std::int64_t most, const std::string& unit) {
    return [=](const std::string& text) {
        const auto n = queue::parse_decimal(text, 0);
        if (n && *n >= least && *n <= most) return std::string();
        return fmt::format("{} is outside {} to {}{}", quote(text), least, most, unit);
    };
}

struct Options {
    tools::DeskOptions desk;
    std::string policy = "priority", ack_wait = "10", listen;
    std::vector<std::string> feedback;
    bool stats = false;

    void add_to(cli::App& app) {
        app.options()
            .add_option("--id", desk.scheduler.own_id,
                        "Modem ID of this vehicle, 1 to 30; required")
            ->option_text("N")
            ->check(is_within(1, 30, ""));
        app.options()
            .add_option("--policy", policy, "What wins a turn: priority, value, ttl, oldest")
            ->option_text("NAME")
            ->check(is_policy);
        app.options()
            .add_option("--spool", desk.spool, "Keep accepted messages in FILE over a restart")
            ->option_text("FILE");
        app.options()
            .add_option("--listen", listen,
                        "Take messages on a socket, and answer when they are safe")
            ->option_text("SOCKET");
        app.options()
            .add_option("--feedback", feedback, "Read what the modem says from FIFO; may repeat")
            ->allow_extra_args(false)
            ->option_text("FIFO");
        app.options()
            .add_option("--ack-wait", ack_wait, "Send again when not acknowledged for so long (10)")
            ->option_text("SECONDS")
            ->check(is_wait);
        app.options()
            .add_option("--max-frame", desk.scheduler.max_frame_bytes,
                        "Drop a message larger than the largest frame (256)")
            ->option_text("BYTES")
            ->check(is_within(1, 2048, " bytes"));
        app.options().add_flag("--explain", desk.explain, "Write each contest");
        app.options().add_flag("--stats", stats, "Write what became of each queue at the end");
        app.config_sections(
            {"queue",
             "How queues behave: [queue] for all, [queue.ID] for a DCCL id, [queue.ID.DEST] for "
             "one "
             "destination of it",
             {{"ack", "Ask for an acknowledgement where the message does not say", "true"},
              {"blackout_time_s", "Least time between two messages, seconds", "0"},
              {"max_queue", "Most messages, waiting or under way", "100"},
              {"newest_first", "Newest first, and drop the oldest when full; else oldest first",
               "true"},
              {"ttl_s", "Age at which a message is dropped, seconds, or infinite", "1800"},
              {"value_base", "What a message is worth, beside those of other queues", "1"}},
             [this](const std::string& section, const std::string& key, const std::string& value) {
                 desk.scheduler.queues.set(section, key, value);
             }});
    }
};

}  // namespace

int main(int argc, char** argv) {
    Options options;
    cli::App app{
        "queue-sched",
        "Say which messages are worth sending in each turn to speak.",
        "  tdma-slot -c slots.conf | queue-sched --id 3 --spool q.db | mm-serial /dev/ttyS0\n",
        {.config = true, .clock = true}};
    app.input_formats(tools::record_formats);
    app.output_formats(tools::record_formats);
    options.add_to(app);
    return app.main(argc, argv, [&](cli::Io& io) {
        if (options.desk.scheduler.own_id == 0)
            throw Error(ExitCode::usage, "option --id is required (try --help)");
        options.desk.scheduler.policy = *queue::parse_policy(options.policy);
        options.desk.scheduler.ack_wait_ns = *queue::parse_decimal(options.ack_wait, 9);
        cli::Loop loop(io);
        tools::QueueDesk desk(io, loop, std::move(options.desk));
        loop.inputs(desk.framing(), [&](std::string_view record) { desk.from_input(record); });
        for (const std::string& fifo : options.feedback)
            loop.fifo(fifo, desk.framing(), [&](std::string_view r) { desk.from_feedback(r); });
        if (!options.listen.empty()) {
            loop.listen(options.listen, [&](std::string_view packet, std::uint64_t client) {
                desk.from_socket(packet, client);
            });
        }
        loop.on_wake([&] { desk.wake(); });
        loop.before_wait([&] { desk.before_wait(); });
        loop.on_signal(SIGUSR1, [&] { desk.write_stats(); });
        loop.run();
        desk.finish();
        if (options.stats) desk.write_stats();
        desk.leave();
    });
}
