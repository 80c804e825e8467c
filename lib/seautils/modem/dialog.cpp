#include "seautils/modem/dialog.hpp"

#include <algorithm>

namespace seautils::modem {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

}  // namespace

/// Before the others; behind front() where that waits for its answer.
void Dialog::push_front(Command command) {
    queue_.insert(queue_.begin() + (tries_ > 0 ? 1 : 0), std::move(command));
}

void Dialog::clear() {
    queue_.clear();
    tries_ = 0;
    again_ = false;
    unanswered_ = 0;
}

Dialog::Step Dialog::step(std::int64_t steady_ns) {
    if (queue_.empty()) return Step::wait;
    if (tries_ == 0) return Step::say;
    const bool once = front().kind == Command::Kind::pause || front().kind == Command::Kind::query;
    if (!again_) {
        if (steady_ns < due_) return Step::wait;
        again_ = true;
        if (!once && ++unanswered_ >= failures) return Step::dead;
    }
    return once || tries_ >= tries ? Step::give_up : Step::say;
}

void Dialog::said(std::int64_t steady_ns, std::chrono::nanoseconds within) {
    ++tries_;
    again_ = false;
    due_ = steady_ns + within.count();
}

void Dialog::pop() {
    queue_.pop_front();
    tries_ = 0;
    again_ = false;
}

bool Dialog::is_answer(const stream::Sentence& s) const {
    if (tries_ == 0) return false;
    const std::string& reply = front().reply;
    const std::string_view body = s.body();
    if (reply.empty() || body.size() < reply.size()) return false;
    const bool whole = body.size() == reply.size() || body[reply.size()] == ',';
    return whole && std::equal(reply.begin(), reply.end(), body.begin(),
                               [](char a, char b) { return lower(a) == lower(b); });
}

void Dialog::word(std::string body, std::string reply) {
    queue_.front().body = std::move(body);
    queue_.front().reply = std::move(reply);
}

void Dialog::forgotten() {
    tries_ = 0;
    again_ = false;
}

std::optional<std::int64_t> Dialog::wake() const {
    return tries_ > 0 ? std::optional(due_) : std::nullopt;
}

}  // namespace seautils::modem
