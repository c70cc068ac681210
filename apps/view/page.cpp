#include "page.h"

#include "gzip.h"

namespace cairn::view {

namespace {

constexpr unsigned char bytes[] = {
#include <page_bytes.inc>
};

}  // namespace

std::string_view compressedPage() {
    return {reinterpret_cast<const char*>(bytes), sizeof(bytes)};
}

std::string page() {
    return gunzip(compressedPage());
}

}  // namespace cairn::view
