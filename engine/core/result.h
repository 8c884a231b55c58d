// A value, or the error that kept it from being made.
//
// The world (files, bytes, network, users) fails through Result; a caller's bug asserts;
// running out of memory throws. `server/http/problem` alone turns codes into HTTP statuses.
// Member names follow C++23's std::expected, which g++ 12 lacks.
//
// Errors  value() on an error and error() on a value are a caller's bug and assert.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace haarmony {

enum class ErrorCode {
    kInvalidArgument,    // a value outside its documented range
    kNotFound,           // no such row, file or profile
    kConflict,           // the state forbids it (already there, built in)
    kUnsupportedFormat,  // bytes of no format that we read
    kUndecodable,        // a known format whose bytes are damaged
    kTooLarge,           // more bytes or pixels than the limit
    kForbidden,          // refused by configuration
    kNotADatabase,       // an existing file that is not ours
    kNewerVersion,       // written by a newer version than this one
    kUnavailable,        // busy, shutting down, or a peer that does not answer
    kIo,                 // the operating system said no
};

// `message` is one line and carries the bad value; `param` names the input it came from,
// where there is one.
struct Error {
    ErrorCode code = ErrorCode::kIo;
    std::string message;
    std::string param = {};
};

template <typename T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    [[nodiscard]] T& value() & { return *std::get_if<0>(check<0>()); }
    [[nodiscard]] const T& value() const& { return *std::get_if<0>(check<0>()); }
    [[nodiscard]] T&& value() && { return std::move(*std::get_if<0>(check<0>())); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    [[nodiscard]] const Error& error() const& { return *std::get_if<1>(check<1>()); }
    [[nodiscard]] Error&& error() && { return std::move(*std::get_if<1>(check<1>())); }

  private:
    template <std::size_t I>
    std::variant<T, Error>* check() {
        assert(state_.index() == I);
        return &state_;
    }
    template <std::size_t I>
    const std::variant<T, Error>* check() const {
        assert(state_.index() == I);
        return &state_;
    }

    std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : error_(std::move(error)), failed_(true) {}

    [[nodiscard]] bool has_value() const { return !failed_; }
    explicit operator bool() const { return has_value(); }
    [[nodiscard]] const Error& error() const& {
        assert(failed_);
        return error_;
    }
    [[nodiscard]] Error&& error() && {
        assert(failed_);
        return std::move(error_);
    }

  private:
    Error error_;
    bool failed_ = false;
};

}  // namespace haarmony
