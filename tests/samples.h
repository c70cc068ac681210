/// @file How many random cases a test takes.
#pragma once

namespace cairn {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool with_sanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool with_sanitizer = true;
#else
inline constexpr bool with_sanitizer = false;
#endif
#else
inline constexpr bool with_sanitizer = false;
#endif

/// The number, or a tenth of it with sanitizers, which take ten times as long and look at memory, not at results.
constexpr int samples(int number) {
    return with_sanitizer ? number / 10 : number;
}

}  // namespace cairn
