#include "seautils/cli/loop.hpp"

#include "seautils/cli/source.hpp"
#include "seautils/core/error.hpp"
#include "seautils/stream/fifo.hpp"
#include "seautils/stream/packet_socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <map>

namespace seautils::cli {

namespace {

constexpr int records_a_turn = 256;  ///< so that one busy input does not starve the others
constexpr std::size_t max_clients = 1000;

/// Where the handler of signals writes to; handlers cannot be told it in another way.
volatile sig_atomic_t signal_pipe = -1;

/// A second signal of the kind acts at once.
void on_signal_arrived(int number) {
    const int error = errno;
    const auto byte = static_cast<unsigned char>(number);
    if (::write(signal_pipe, &byte, 1) < 0) ::raise(number);
    errno = error;
}

/// Wakes at times of one of the system's clocks.
class Timer {
public:
    explicit Timer(clockid_t clock) : fd_(::timerfd_create(clock, TFD_NONBLOCK | TFD_CLOEXEC)) {
        if (fd_ < 0)
            throw Error(ExitCode::internal, "no timer: " + std::string(std::strerror(errno)));
    }
    ~Timer() { ::close(fd_); }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

    int descriptor() const { return fd_; }

    /// @param flags  beside TFD_TIMER_ABSTIME
    void set(std::optional<std::int64_t> ns, int flags) {
        itimerspec when{};
        if (ns) {
            const std::int64_t at = std::max<std::int64_t>(*ns, 1);  // 0 would stop it
            when.it_value = {at / 1'000'000'000, at % 1'000'000'000};
        }
        ::timerfd_settime(fd_, TFD_TIMER_ABSTIME | flags, &when, nullptr);
    }

    /// Takes an expiry; false: the clock was stepped instead.
    bool take() {
        std::uint64_t count = 0;
        return ::read(fd_, &count, sizeof count) >= 0 || errno != ECANCELED;
    }

private:
    int fd_;
};

/// A client of the socket.
struct Client {
    int fd = -1;
    std::uint64_t id = 0;
};

}  // namespace

struct Loop::Impl {
    explicit Impl(Io& the_io);
    ~Impl();

    struct Channel {
        Channel(std::string name, int fd, stream::Input::Options options, Framing how,
                OnRecord what)
            : source(std::move(name), fd, "", std::move(options)),
              framing(how),
              record(std::move(what)) {}
        Source source;
        Framing framing;
        OnRecord record;
        bool of_files = false;
        bool more = false;  ///< the last turn ended before what is held was used up
    };

    Io& io;
    std::deque<std::string> files;  ///< still to be opened
    Framing files_framing = Framing::lines;
    OnRecord files_record;
    bool has_files = false;
    std::function<void()> inputs_ended, wake, step, wait_hook;
    const Channel* taken = nullptr;  ///< whose record is being handled, or was last
    std::vector<std::unique_ptr<Channel>> channels;
    std::map<int, std::function<void()>> watched;
    std::map<int, std::function<void()>> signals;
    std::vector<int> handled;
    int signal_read = -1, signal_write = -1;
    int listener = -1;
    std::string listener_path;
    OnPacket packet;
    std::vector<Client> clients;
    std::uint64_t next_client = 1;
    Timer wall{CLOCK_REALTIME}, steady{CLOCK_BOOTTIME};
    std::optional<std::int64_t> utc_wake, steady_wake;
    bool stopped = false;

    void open_next_file();
    void handle_signal(int number);
    bool read_some(Channel& channel);
    void take(Channel& channel, std::string_view record);
    void accept_clients();
    bool serve(const Client& client);
    void forget(std::uint64_t id);
    void set_timers();
    void fire_if_due();
    void take_signals();
    void take_timers(bool wall_ready, bool steady_ready);
    void add_channel(const std::string& name, int fd, Framing framing, OnRecord record);
    void wait(std::vector<pollfd>& ready);
    void watched_turn(const std::vector<pollfd>& ready, std::size_t first, std::size_t end);
    void channel_turn(const std::vector<pollfd>& ready, std::size_t first);
    void client_turn(const std::vector<pollfd>& ready, std::size_t first);
    void turn();
    bool has_input_left() const;
};

Loop::Impl::Impl(Io& the_io) : io(the_io) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
        throw Error(ExitCode::internal, "no pipe: " + std::string(std::strerror(errno)));
    signal_read = ends[0];
    signal_write = ends[1];
    signal_pipe = signal_write;
    for (const int number : {SIGTERM, SIGINT}) {
        signals[number] = [this, number] {
            io.ended_by = number;
            stopped = true;
        };
        handle_signal(number);
    }
}

/// The socket goes first: from the moment on that signals end the process again, nothing is left.
Loop::Impl::~Impl() {
    if (listener >= 0) {
        ::close(listener);
        ::unlink(listener_path.c_str());
    }
    for (const int number : handled) ::signal(number, SIG_DFL);
    signal_pipe = -1;
    ::close(signal_read);
    ::close(signal_write);
    for (const Client& client : clients) ::close(client.fd);
}

/// The end by a signal is the system's again when the signal comes twice.
void Loop::Impl::handle_signal(int number) {
    struct sigaction action {};
    action.sa_handler = on_signal_arrived;
    const bool ends = number == SIGTERM || number == SIGINT;
    action.sa_flags = ends ? static_cast<int>(SA_RESETHAND) : SA_RESTART;
    struct sigaction before {};
    ::sigaction(number, nullptr, &before);
    if (ends && before.sa_handler == SIG_IGN) return;  // nohup and the like: it stays ignored
    ::sigaction(number, &action, nullptr);
    handled.push_back(number);
}

void Loop::Impl::open_next_file() {
    const std::string file = files.front();
    files.pop_front();
    OpenedFile opened = open_input(file, files_framing == Framing::lines);
    if (opened.is_terminal) io.inform("reading from the terminal (end with Ctrl-D)");
    if (io.follow && file != "-") {
        if (!opened.is_fifo)
            throw Error(ExitCode::usage, file + ": option --follow is for FIFOs here");
        ::close(opened.fd);
        opened.fd = stream::open_fifo(file);
    }
    add_channel(opened.name, opened.fd, files_framing, files_record);
    channels.back()->of_files = true;
}

void Loop::Impl::add_channel(const std::string& name, int fd, Framing framing, OnRecord record) {
    stream::Input::Options options;
    options.max_record = io.max_record;
    options.may_wait = false;
    channels.push_back(
        std::make_unique<Channel>(name, fd, std::move(options), framing, std::move(record)));
}

void Loop::Impl::take(Channel& channel, std::string_view record) {
    if (record.empty() && channel.framing == Framing::lines) return;
    taken = &channel;
    try {
        channel.record(record);
    } catch (const DataError& e) {
        io.refuse(channel.source.place(channel.framing), e.what());
    }
}

/// Reads what is there, up to a turn's worth. False: the input has ended.
bool Loop::Impl::read_some(Channel& channel) {
    using Got = stream::Input::Got;
    channel.more = false;
    for (int k = 0; k < records_a_turn && !stopped; ++k) {
        std::string_view record;
        switch (channel.source.next(channel.framing, record)) {
            case Got::record:
                take(channel, record);
                break;
            case Got::too_long:
                io.refuse(channel.source.place(channel.framing),
                          "longer than " + std::to_string(io.max_record) + " bytes (--max-record)");
                break;
            case Got::wait:
                return true;
            case Got::end:
                return false;
        }
    }
    return channel.more = true;
}

bool Loop::Impl::has_input_left() const {
    return !files.empty() || std::any_of(channels.begin(), channels.end(),
                                         [](const auto& channel) { return channel->of_files; });
}

void Loop::Impl::accept_clients() {
    for (;;) {
        const int fd = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
        if (fd < 0) return;
        if (clients.size() >= max_clients) {
            ::close(fd);
            continue;
        }
        clients.push_back({fd, next_client++});
    }
}

/// Takes one packet. False: the client has gone.
bool Loop::Impl::serve(const Client& client) {
    char bytes[max_packet + 1];
    const ssize_t n = ::recv(client.fd, bytes, sizeof bytes, 0);
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    if (n == 0) return false;
    try {
        if (n > static_cast<ssize_t>(max_packet))
            throw DataError("longer than " + std::to_string(max_packet) + " bytes");
        packet({bytes, static_cast<std::size_t>(n)}, client.id);
    } catch (const DataError& e) {
        const std::string answer = std::string("error: ") + e.what();
        return ::send(client.fd, answer.data(), answer.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
    }
    return true;
}

void Loop::Impl::forget(std::uint64_t id) {
    std::erase_if(clients, [&](const Client& client) {
        if (client.id == id) ::close(client.fd);
        return client.id == id;
    });
}

/// With the system's clock the wall timer also tells when it is stepped, whether or not there is
/// anything to wake for.
void Loop::Impl::set_timers() {
    if (io.clock.is_input()) return;
    std::optional<std::int64_t> boot;
    if (steady_wake) boot = io.clock.boot_ns_at_steady(*steady_wake);
    if (io.clock.is_system()) {
        constexpr std::int64_t never = INT64_MAX / 2;
        wall.set(utc_wake.value_or(never), TFD_TIMER_CANCEL_ON_SET);
    } else if (utc_wake) {
        const std::int64_t at = *io.clock.boot_ns_at(*utc_wake);
        boot = boot ? std::min(*boot, at) : at;
    }
    steady.set(boot, 0);
}

void Loop::Impl::fire_if_due() {
    const bool utc = utc_wake && io.clock.now_ns() >= *utc_wake;
    const bool steadily = steady_wake && io.clock.steady_ns() >= *steady_wake;
    if (utc) utc_wake.reset();
    if (steadily) steady_wake.reset();
    if ((utc || steadily) && wake) wake();
    set_timers();
}

void Loop::Impl::take_signals() {
    unsigned char number = 0;
    while (::read(signal_read, &number, 1) == 1) {
        const auto found = signals.find(number);
        if (found != signals.end()) found->second();
    }
}

void Loop::Impl::take_timers(bool wall_ready, bool steady_ready) {
    if (wall_ready && !wall.take() && step) step();
    if (steady_ready) steady.take();
    if (wall_ready || steady_ready) fire_if_due();
}

/// Flushes, and calls the tool's hook, only where it has to wait.
void Loop::Impl::wait(std::vector<pollfd>& ready) {
    const bool busy = std::any_of(channels.begin(), channels.end(),
                                  [](const auto& channel) { return channel->more; });
    for (int timeout = 0;; timeout = -1) {
        const int count = ::poll(ready.data(), ready.size(), timeout);
        if (count > 0 || (count == 0 && busy)) return;
        if (count < 0 && errno != EINTR)
            throw Error(ExitCode::internal, std::string("poll failed: ") + std::strerror(errno));
        if (wait_hook) wait_hook();
        io.out.flush();
        if (stopped) return;
    }
}

void Loop::Impl::watched_turn(const std::vector<pollfd>& ready, std::size_t first,
                              std::size_t end) {
    for (std::size_t k = first; k < end && !stopped; ++k) {
        const auto found = watched.find(ready[k].fd);  // an action may unwatch another's
        if (ready[k].revents == 0 || found == watched.end()) continue;
        const auto action = found->second;
        action();
    }
}

void Loop::Impl::channel_turn(const std::vector<pollfd>& ready, std::size_t first) {
    std::vector<const Channel*> ended;
    for (std::size_t k = 0; k < channels.size() && !stopped; ++k) {
        Channel& channel = *channels[k];
        const bool came = channel.more || ready[first + k].revents != 0;
        if (came && !read_some(channel)) ended.push_back(&channel);
    }
    std::erase_if(channels, [&](const auto& channel) {
        return std::find(ended.begin(), ended.end(), channel.get()) != ended.end();
    });
}

void Loop::Impl::client_turn(const std::vector<pollfd>& ready, std::size_t first) {
    const std::vector<Client> asking = clients;
    for (std::size_t k = 0; k < asking.size() && !stopped; ++k) {
        if (ready[first + k].revents != 0 && !serve(asking[k])) forget(asking[k].id);
    }
}

/// Waits once, and handles what came: signals and times first, then what the tool watches, then
/// records and packets.
void Loop::Impl::turn() {
    std::vector<pollfd> ready{{signal_read, POLLIN, 0},
                              {wall.descriptor(), POLLIN, 0},
                              {steady.descriptor(), POLLIN, 0},
                              {listener, POLLIN, 0}};
    const std::size_t first_watched = ready.size();
    for (const auto& [fd, action] : watched) ready.push_back({fd, POLLIN, 0});
    const std::size_t first_channel = ready.size();
    for (const auto& channel : channels)
        ready.push_back({channel->source.input().descriptor(), POLLIN, 0});
    const std::size_t first_client = ready.size();
    for (const Client& client : clients) ready.push_back({client.fd, POLLIN, 0});
    wait(ready);
    if (ready[0].revents != 0) take_signals();
    if (stopped) return;
    take_timers(ready[1].revents != 0, ready[2].revents != 0);
    watched_turn(ready, first_watched, first_channel);
    channel_turn(ready, first_channel);
    client_turn(ready, first_client);
    if (ready[3].revents != 0) accept_clients();
}

Loop::Loop(Io& io) : impl_(std::make_unique<Impl>(io)) {}
Loop::~Loop() = default;

void Loop::inputs(Framing framing, OnRecord record) {
    Impl& a = *impl_;
    a.files_framing = framing;
    a.files_record = std::move(record);
    a.has_files = true;
    a.files.assign(a.io.files.begin(), a.io.files.end());
    if (a.files.empty()) a.files.emplace_back("-");
}

void Loop::on_inputs_ended(std::function<void()> action) {
    impl_->inputs_ended = std::move(action);
}

void Loop::fifo(const std::string& path, Framing framing, OnRecord record) {
    impl_->add_channel(path, stream::open_fifo(path), framing, std::move(record));
}

void Loop::listen(const std::string& path, OnPacket packet) {
    impl_->listener = stream::listen_packets(path);
    impl_->listener_path = path;
    impl_->packet = std::move(packet);
}

void Loop::reply(std::uint64_t client, std::string_view answer) {
    for (const Client& one : impl_->clients) {
        if (one.id != client) continue;
        const ssize_t n = ::send(one.fd, answer.data(), answer.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (n < 0) impl_->forget(client);
        return;
    }
}

void Loop::watch(int fd, std::function<void()> ready) { impl_->watched[fd] = std::move(ready); }
void Loop::unwatch(int fd) { impl_->watched.erase(fd); }

void Loop::on_wake(std::function<void()> action) { impl_->wake = std::move(action); }

void Loop::wake_at(std::optional<std::int64_t> utc_ns) {
    if (impl_->utc_wake == utc_ns) return;
    impl_->utc_wake = utc_ns;
    impl_->set_timers();
}

void Loop::wake_at_steady(std::optional<std::int64_t> steady_ns) {
    if (impl_->steady_wake == steady_ns) return;
    impl_->steady_wake = steady_ns;
    impl_->set_timers();
}

void Loop::on_clock_step(std::function<void()> action) { impl_->step = std::move(action); }

void Loop::on_signal(int number, std::function<void()> action) {
    impl_->signals[number] = std::move(action);
    impl_->handle_signal(number);
}

std::uint64_t Loop::record_number() const {
    return impl_->taken == nullptr ? 0 : impl_->taken->source.input().count();
}

void Loop::before_wait(std::function<void()> action) { impl_->wait_hook = std::move(action); }

std::string Loop::place() const {
    return impl_->taken == nullptr ? "" : impl_->taken->source.place(impl_->taken->framing);
}

void Loop::advance(std::int64_t utc_ns) {
    Impl& a = *impl_;
    if (!a.io.clock.is_input()) return;
    for (;;) {
        std::optional<std::int64_t> next = a.utc_wake;
        if (a.steady_wake && (!next || *a.steady_wake < *next)) next = a.steady_wake;
        if (!next || *next > utc_ns) break;
        a.io.clock.advance(*next);
        a.fire_if_due();
    }
    a.io.clock.advance(utc_ns);
}

void Loop::run() {
    Impl& a = *impl_;
    a.set_timers();
    a.fire_if_due();
    while (!a.stopped) {
        if (a.has_files && !a.has_input_left()) {
            a.has_files = false;
            if (!a.inputs_ended) return;
            a.inputs_ended();
            continue;
        }
        const bool reading = std::any_of(a.channels.begin(), a.channels.end(),
                                         [](const auto& channel) { return channel->of_files; });
        if (!reading && !a.files.empty()) {
            a.open_next_file();
            continue;
        }
        a.turn();
    }
}

void Loop::stop() { impl_->stopped = true; }

}  // namespace seautils::cli
