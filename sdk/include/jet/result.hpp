// What can go wrong in a correct program: an Error says what happened, where, and what to do; Result<T> carries it.
#pragma once

#include <jet/version.hpp>

#include <cassert>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace jet {

/// A place in a text file. Line and column count from 1; 0 means "not known".
struct Location {
    std::string file;
    int line = 0;
    int column = 0;
};

/// A failure, told to the person who can mend it. One sentence: what happened and what to do about it.
struct Error {
    std::string message;
    Location where;

    Error() = default;
    Error(std::string text) : message(std::move(text)) {}
    Error(std::string text, Location location) : message(std::move(text)), where(std::move(location)) {}

    /// `file:line:col: error: text`, leaving out the parts of the location that are not known.
    JET_API std::string text() const;
};

/// The same as an exception, for code inside a plugin: the host's guard turns it into a message. [any thread]
class JET_API Failure : public std::runtime_error {
public:
    explicit Failure(Error error);
    Failure(const Failure&);
    ~Failure() override;
    const Error& error() const { return error_; }

private:
    Error error_;
};

/// A value or the Error that prevented it.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return content_.index() == 0; }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(value()); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const
    {
        assert(!*this);
        return std::get<1>(content_);
    }

    /// The value; throws Failure where there is none.
    T orThrow() &&
    {
        if (!*this) throw Failure(error());
        return std::move(value());
    }

private:
    T& value()
    {
        assert(*this);
        return std::get<0>(content_);
    }
    const T& value() const
    {
        assert(*this);
        return std::get<0>(content_);
    }

    std::variant<T, Error> content_;
};

/// Success without a value, or the Error.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)), failed_(true) {}

    explicit operator bool() const { return !failed_; }
    const Error& error() const { return error_; }
    void orThrow() const
    {
        if (failed_) throw Failure(error_);
    }

private:
    Error error_;
    bool failed_ = false;
};

}  // namespace jet
