// Result of an operation on untrusted data: a value, or one error that a user can act on.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"
#include "formats/base/issues.h"

#include <string>
#include <utility>
#include <variant>

namespace hearth
{

/// Problem in an input, described so that the user can find and fix it.
struct Error
{
    /// Stable number; its severity, class and hint are in formats/base/issues.h.
    Issue issue = Issue::internal;
    std::string file;   ///< the file as the user named it; may be empty
    std::string where;  ///< JSON pointer ("/meshes/0"), "line 12", "chunk MESH 3", or empty
    std::string detail; ///< what is wrong, with the offending values
};

/// Format an error as one line: "file|where: error: detail [E1203] hint: ...".
std::string formatMessage(const Error& error);

/// Return the process exit code for an error of this class: 65 malformed input, 66 missing, 70 internal, 73
/// cannot write...
int exitCode(const Error& error);

/// Value or Error. Deliberately without monadic calls: callers test and return.
template <typename T>
class [[nodiscard]] Result
{
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& value() &
    {
        HEARTH_ASSERT(ok());
        return *std::get_if<0>(&state_);
    }
    const T& value() const&
    {
        HEARTH_ASSERT(ok());
        return *std::get_if<0>(&state_);
    }
    T&& value() &&
    {
        HEARTH_ASSERT(ok());
        return std::move(*std::get_if<0>(&state_));
    }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const&
    {
        HEARTH_ASSERT(!ok());
        return *std::get_if<1>(&state_);
    }
    Error&& error() &&
    {
        HEARTH_ASSERT(!ok());
        return std::move(*std::get_if<1>(&state_));
    }

private:
    std::variant<T, Error> state_;
};

struct Empty
{
};
using Status = Result<Empty>;
inline Status success()
{
    return Empty{};
}

} // namespace hearth

/// Return the error of `expression` (a Result or Status) from the function, if it has one.
#define HEARTH_TRY(expression)                                                                               \
    do                                                                                                       \
    {                                                                                                        \
        if (auto hearth_try_result = (expression); !hearth_try_result.ok())                                  \
            return std::move(hearth_try_result).error();                                                     \
    } while (false)

#define HEARTH_CONCAT_(a, b) a##b
#define HEARTH_CONCAT(a, b) HEARTH_CONCAT_(a, b)
/// Assign the value of a Result or return its error: `HEARTH_ASSIGN_OR_RETURN(auto x, f())`.
#define HEARTH_ASSIGN_OR_RETURN(declaration, expression)                                                     \
    auto HEARTH_CONCAT(hearth_result_, __LINE__) = (expression);                                             \
    if (!HEARTH_CONCAT(hearth_result_, __LINE__).ok())                                                       \
        return std::move(HEARTH_CONCAT(hearth_result_, __LINE__)).error();                                   \
    declaration /* NOLINT(bugprone-macro-parentheses) */ =                                                   \
        std::move(HEARTH_CONCAT(hearth_result_, __LINE__)).value()
