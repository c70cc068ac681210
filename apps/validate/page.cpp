#include "page.h"

#include "bench_thesis/page.h"

namespace cairn::validation {

namespace {

constexpr unsigned char bytes[] = {
#include "validation_page.inc"
};

}  // namespace

std::optional<std::string> makePage(const Json& report) {
    return thesis::fillPage(bytes, report);
}

}  // namespace cairn::validation
