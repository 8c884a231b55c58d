// What a step of a handler gives: a value, or the problem that the client is told.
//
// As Result, with a Problem for its error: the codes that clients read ("no_source",
// "several_sources") are finer than ErrorCode. An Error becomes its Problem by itself.
//
// Errors  problem() on a value and value access on a problem are a caller's bug and assert.
#pragma once

#include <cassert>
#include <utility>
#include <variant>

#include "engine/core/result.h"
#include "server/http/message.h"
#include "server/http/problem.h"

namespace haarmony::server {

template <typename T>
class [[nodiscard]] Outcome {
  public:
    Outcome(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Outcome(http::Problem problem) : state_(std::in_place_index<1>, std::move(problem)) {}
    Outcome(const Error& error)
        : state_(std::in_place_index<1>, http::problem_of(error)) {}
    Outcome(Result<T> result)
        : state_(result
                     ? State(std::in_place_index<0>, std::move(result).value())
                     : State(std::in_place_index<1>, http::problem_of(result.error()))) {}

    [[nodiscard]] bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    [[nodiscard]] T& operator*() & { return *checked<0>(); }
    [[nodiscard]] T&& operator*() && { return std::move(*checked<0>()); }
    [[nodiscard]] T* operator->() { return checked<0>(); }
    [[nodiscard]] const http::Problem& problem() { return *checked<1>(); }

  private:
    using State = std::variant<T, http::Problem>;

    template <std::size_t I>
    auto* checked() {
        assert(state_.index() == I);
        return std::get_if<I>(&state_);
    }

    State state_;
};

// What a handler gives; routes.cc turns a problem into its response.
using Reply = Outcome<http::Response>;

}  // namespace haarmony::server
