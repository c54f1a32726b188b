// Ends a program of Hearth after an error or an exception.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdio>
#include <exception>
#include <new>

namespace hearth
{

/// Print an error on stderr.
/// returns  its exit code
inline int reportFailure(const Error& error)
{
    std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
    return exitCode(error);
}

/// Run `body` and return its exit code. An exception becomes a message and the exit code of its issue, where
/// main() would abort: libraries throw, and so does an allocation that fails.
template <typename Body>
int runProgram(const char* name, const Body& body)
{
    try
    {
        return body();
    }
    catch (const std::bad_alloc&)
    {
        return reportFailure({Issue::out_of_memory, name, "", ""});
    }
    catch (const std::exception& exception)
    {
        return reportFailure({Issue::internal, name, "", exception.what()});
    }
}

} // namespace hearth
