/// @file A function as an argument, without owning it.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace cairn {

template <class Signature>
class FunctionRef;

/// Names something that can be called, for the length of a call. Unlike std::function it never takes memory from the
/// heap, which the loops of every step must not.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef> &&
             std::is_invocable_r_v<Result, const Callable&, Arguments...>)
        FunctionRef(const Callable& callable)  // NOLINT(google-explicit-constructor): arguments convert as usual
        : object_(std::addressof(callable)), call_([](const void* object, Arguments... arguments) -> Result {
              return (*static_cast<const Callable*>(object))(std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const { return call_(object_, std::forward<Arguments>(arguments)...); }

  private:
    const void* object_;
    Result (*call_)(const void*, Arguments...);
};

}  // namespace cairn
