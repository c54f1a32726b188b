// The boundary to C: what a call returns, where its message goes, and nothing that is thrown passes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "runtime/c/hearth.h"

#include <exception>
#include <initializer_list>
#include <new>

namespace hearth::c
{

/// Room for the message of a call that fails; zero-terminated, cut off where it is too short.
struct MessageRoom
{
    char* text = nullptr; ///< or none
    size_t size = 0;
};

/// The error of a call that breaks a rule of hearth.h.
Error usage(std::string detail);

/// Write the message of an error, and return the result that stands for it. `function` names the call that is wrong.
hearth_result fail(MessageRoom message, const char* function, const Error& error);

/// Objects of one kind that were made from a handle and are alive.
struct LiveObjects
{
    uint32_t count;
    const char* one;     ///< their kind in the singular
    const char* several; ///< and in the plural
};

/// HEARTH_ERROR_IN_USE, where there are any; else HEARTH_OK. The message counts them: "2 scenes and 1 player are alive".
/// owner  what they were made from: "pack"
hearth_result checkUnused(MessageRoom message, const char* function, const char* owner,
                          std::initializer_list<LiveObjects> objects) noexcept;

/// Run a call: `body` returns a Status, and changes nothing where it fails.
template <typename Body>
hearth_result call(MessageRoom message, const char* function, const Body& body) noexcept
try
{
    const Status status = body();
    return status.ok() ? HEARTH_OK : fail(message, function, status.error());
}
catch (const std::bad_alloc&)
{
    return fail(message, function, {Issue::out_of_memory, "", "", ""});
}
catch (const std::exception& exception)
{
    return fail(message, function, {Issue::internal, "", "", exception.what()});
}

/// errors: usage, where a struct of the caller is missing or of another version.
Status checkStruct(const char* name, const uint32_t* struct_size, size_t expected_size);

template <typename Struct>
Status checkStruct(const char* name, const Struct* value)
{
    return checkStruct(name, value == nullptr ? nullptr : &value->struct_size, sizeof(Struct));
}

} // namespace hearth::c
