// Requests of tl-model, one a line: what is wrong with one is said in a decent message, and what is known then is as before.
#include "common.hpp"

#include "../../tools/tl_request.hpp"
#include "../../tools/tl_schema.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"

#include <algorithm>

namespace st = seautils::tools;

namespace {

void read(std::string_view bytes, bool binary, const st::TlSchema& schema, st::TlKnown& known) {
    seautils::schema::JsonReader json;
    seautils::schema::Values values;
    st::TlKnown next = known;
    const bool good = fuzz::accepted([&] {
        if (binary)
            seautils::schema::read_binary(bytes, schema.request(), values);
        else
            json.read(bytes, schema.request(), values);
        next.merge(values);
        const st::TlTask task = next.task();
        fuzz::require(task.environment.receivers.count() <= st::TlKnown::most_cells,
                      "receivers are bounded");
        seautils::propagation::check(task.environment);
    });
    if (good) known = std::move(next);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const st::TlSchema schema;
    std::string_view text = fuzz::view(data, size);
    fuzz::context = text;
    st::TlKnown known({}, false);
    read(text, true, schema, known);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string line = std::string(text.substr(0, end)) + std::string(64, '\0');
        read(std::string_view(line).substr(0, end), false, schema, known);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return 0;
}
