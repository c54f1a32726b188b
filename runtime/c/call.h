// C boundary: converts errors to results and messages, and stops exceptions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "runtime/c/hearth.h"

#include <exception>
#include <initializer_list>
#include <new>

namespace hearth::c
{

/// Buffer for the message of a failed call; zero-terminated, truncated if it is too short.
struct MessageBuffer
{
    char* text = nullptr; ///< or null
    size_t size = 0;
};

/// Make the error of a call that breaks a rule of hearth.h.
Error usage(std::string detail);

/// Write the message of an error, and return its result code. `function` names the failed call.
hearth_result fail(MessageBuffer message, const char* function, const Error& error);

/// Living objects of one kind that were made from a handle.
struct LiveObjectCount
{
    uint32_t count;
    const char* one;     ///< name of the kind, singular
    const char* several; ///< name of the kind, plural
};

/// Return HEARTH_ERROR_IN_USE if any object is alive, else HEARTH_OK. The message counts the objects: "2
/// scenes and 1 player are alive".
/// owner  kind of the handle that they were made from: "pack"
hearth_result checkUnused(MessageBuffer message, const char* function, const char* owner,
                          std::initializer_list<LiveObjectCount> objects) noexcept;

/// Run a call: `body` returns a Status, and changes nothing if it fails.
template <typename Body>
hearth_result call(MessageBuffer message, const char* function, const Body& body) noexcept
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

/// errors: usage if a struct of the caller is missing or of another version.
Status checkStruct(const char* name, const uint32_t* struct_size, size_t expected_size);

template <typename Struct>
Status checkStruct(const char* name, const Struct* value)
{
    return checkStruct(name, value == nullptr ? nullptr : &value->struct_size, sizeof(Struct));
}

} // namespace hearth::c
