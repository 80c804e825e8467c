// What mm-serial's command line says.
#ifndef SEAUTILS_TOOLS_MM_SERIAL_OPTIONS_HPP
#define SEAUTILS_TOOLS_MM_SERIAL_OPTIONS_HPP

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/modem/options.hpp"
#include "seautils/stream/whole_file.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

struct MmSerialOptions {
    modem::Options modem;
    std::vector<std::string> settings, feedback;
    std::string rates, lbl, transponders;
    double poll_wait_s = 2;
    std::optional<double> linger_s;
    bool replay = false, no_reset = false;
    unsigned id = 0;  ///< 0: not said

    void add_to(cli::App& app);
    /// What the strings mean. @throws Error(usage), ConfigError
    void settle();

private:
    void add_modem(CLI::App& app);
    void add_lbl(CLI::App& app);
    void settle_settings();
    void settle_lbl();
};

inline void MmSerialOptions::add_modem(CLI::App& app) {
    app.add_option("--id", id, "The modem's address, 1 to 30")->option_text("N");
    app.add_option("--set", settings, "A setting of the modem, written at its start; may repeat")
        ->allow_extra_args(false)
        ->option_text("NAME=VALUE");
    app.add_flag("--factory-settings", modem.reset_settings, "First put all settings back");
    app.add_flag("--no-reset", no_reset, "Do not start the modem anew");
    app.add_flag("--query", modem.query, "Ask for all settings when the modem is ready");
    app.add_option("--baud", modem.baud, "Speed of the serial line (19200)")->option_text("N");
    app.add_option("--gateway", modem.gateway, "The modem is behind gateway buoy N")
        ->option_text("N");
    app.add_option("--rates", rates, "Take frames and air times from FILE")->option_text("FILE");
    app.add_flag("--flexible", modem.flexible, "Send data as flexible data packets");
    app.add_option("--poll-wait", poll_wait_s, "Wait so long for the data of a poll, 0.1 to 60 (2)")
        ->option_text("SECONDS")
        ->check(CLI::Range(0.1, 60.0));
}

inline void MmSerialOptions::add_lbl(CLI::App& app) {
    app.add_option("--sound-speed", modem.sound_speed_mps, "What ranges are computed with (1500)")
        ->option_text("M/S");
    app.add_option("--lbl", lbl, "Transponders: remus (default), narrowband or coded")
        ->option_text("KIND");
    app.add_option("--lbl-range", modem.lbl.max_range_m, "To the farthest transponder (1000)")
        ->option_text("M");
    app.add_option("--lbl-turnaround", modem.lbl.turnaround_ms, "Of the transponders (50)")
        ->option_text("MS");
    app.add_option("--lbl-transponders", transponders, "Which of A to D are asked (ABCD)")
        ->option_text("LETTERS");
    app.add_option("--lbl-transmit", modem.lbl.transmit_hz, "Frequency of the question (26000)")
        ->option_text("HZ");
    app.add_option("--lbl-receive", modem.lbl.receive_hz,
                   "Frequency of an answer (25000); may repeat, at most 4")
        ->allow_extra_args(false)
        ->option_text("HZ");
    app.add_option("--lbl-ping", modem.lbl.transmit_ms, "Length of a narrowband question (5)")
        ->option_text("MS");
    app.add_option("--lbl-answer", modem.lbl.receive_ms, "Length of a narrowband answer (5)")
        ->option_text("MS");
    app.add_option("--lbl-code", modem.lbl.transmit_code, "Code of a coded question (0)")
        ->option_text("N");
    app.add_option("--lbl-answer-code", modem.lbl.receive_codes,
                   "Code of a coded answer; may repeat, at most 4")
        ->allow_extra_args(false)
        ->option_text("N");
    app.add_option("--lbl-code-bits", modem.lbl.code_bits, "Length of the codes (7)")
        ->option_text("N");
    app.add_option("--lbl-bandwidth", modem.lbl.bandwidth_hz, "Of the codes (4000)")
        ->option_text("HZ");
}

inline void MmSerialOptions::add_to(cli::App& app) {
    CLI::App& options = app.options();
    options.add_flag("--replay", replay, "Read logs of a dialogue, FILE..., with no device");
    add_modem(options);
    add_lbl(options);
    options
        .add_option("--feedback", feedback,
                    "Write ack, result, slot and who was heard to FIFO too; may repeat")
        ->allow_extra_args(false)
        ->option_text("FIFO");
    options.add_flag("--raw", modem.raw, "Write each line of the serial line too");
    options.add_option("--linger", linger_s, "End so long after the end of the input (not at all)")
        ->option_text("SECONDS")
        ->check(CLI::Range(0.0, 1e6));
}

inline void MmSerialOptions::settle_settings() {
    for (const std::string& text : settings) {
        const std::size_t equal = text.find('=');
        if (equal == text.npos || equal == 0)
            throw Error(ExitCode::usage, "option --set: " + quote(text) + " is not NAME=VALUE");
        modem.settings.push_back({text.substr(0, equal), text.substr(equal + 1)});
    }
}

inline void MmSerialOptions::settle_lbl() {
    const std::map<std::string, modem::Lbl::Kind> kinds = {
        {"", modem::Lbl::Kind::remus},
        {"remus", modem::Lbl::Kind::remus},
        {"narrowband", modem::Lbl::Kind::narrowband},
        {"coded", modem::Lbl::Kind::coded}};
    const auto kind = kinds.find(lbl);
    if (kind == kinds.end())
        throw Error(ExitCode::usage,
                    "option --lbl: " + quote(lbl) + " is none of remus, narrowband, coded");
    modem.lbl.kind = kind->second;
    if (transponders.empty()) return;
    modem.lbl.transponders = 0;
    for (const char c : transponders) {
        if (c < 'A' || c > 'D')
            throw Error(ExitCode::usage,
                        "option --lbl-transponders: " + quote({&c, 1}) + " is not A to D");
        modem.lbl.transponders |= 1U << (c - 'A');
    }
}

inline void MmSerialOptions::settle() {
    settle_settings();
    settle_lbl();
    modem.reset = !no_reset;
    modem.id = id;
    modem.poll_wait = std::chrono::milliseconds(static_cast<std::int64_t>(poll_wait_s * 1000));
    if (!rates.empty())
        modem.rates = RateTable::parse(stream::read_input_file(rates, 1U << 20), rates);
    if (replay) {
        if (id == 0) modem.id = 1;
    } else if (id == 0) {
        throw Error(ExitCode::usage, "option --id is required (try --help)");
    }
    try {
        modem.check();
    } catch (const DataError& e) {
        throw Error(ExitCode::usage, e.what());
    }
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_MM_SERIAL_OPTIONS_HPP
