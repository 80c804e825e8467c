// Any bytes as a log, and as what a modem says to the driver while time passes: both take it or refuse
// it decently, and every record can be written.
#include "common.hpp"

#include "seautils/modem/driver.hpp"
#include "seautils/modem/replay.hpp"
#include "seautils/record/codec.hpp"

using namespace seautils;

namespace {

void check(std::vector<record::Record>& records) {
    static record::Codec codec;
    std::string bytes;
    for (const record::Record& r : records) {
        fuzz::accepted([&] { codec.write(r, record::Form::ndjson, bytes); });
        fuzz::accepted([&] { codec.write(r, record::Form::delimited, bytes); });
    }
    records.clear();
}

/// Lines that begin with a digit let that many seconds pass, and ask for something to be sent.
void drive(modem::Driver& driver, std::string_view line, modem::Moment& now) {
    if (!line.empty() && line[0] >= '0' && line[0] <= '9') {
        const std::int64_t ns = (line[0] - '0') * 1'000'000'000LL;
        now = {{now.utc.ns + ns}, now.steady_ns + ns};
        driver.tick(now);
        record::Transmission t;
        t.src = 1;
        t.dest = static_cast<std::uint32_t>(line.size() % 4);
        t.rate = static_cast<std::uint32_t>(line.size() % 8);
        t.kind = static_cast<record::Kind>(line.size() % 5);
        t.mini = 5;
        t.ack_requested = true;
        t.polled = line.ends_with('p');
        t.frame = {std::string(line.substr(0, 32)), "x"};
        t.frame.resize(1 + line.size() % 2);
        driver.transmit(t, now);
    } else {
        driver.line(line, now);
    }
    check(driver.output().records);
    driver.output().to_modem.clear();
    if (std::exchange(driver.output().reopen, false)) driver.opened(now);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest = fuzz::view(data, size);
    modem::Replay replay({}, 1500, true);
    modem::Options options;
    options.raw = true;
    options.reset = false;
    modem::Driver driver(options);
    modem::Moment now{{1'714'564'800'000'000'000}, 0};
    driver.opened(now);
    std::vector<record::Record> records;
    while (!rest.empty()) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, length);
        rest.remove_prefix(std::min(length + 1, rest.size()));
        fuzz::accepted([&] { replay.line(line, records); });
        check(records);
        drive(driver, line, now);
    }
    replay.end(records);
    check(records);
    return 0;
}
