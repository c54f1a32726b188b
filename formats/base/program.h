// How a program of Hearth ends when something fails or is thrown.
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

/// Return what `body` returns, its exit code. What it throws becomes a message and the exit code of that issue, where
/// main() would abort: libraries throw, and so does memory that runs out.
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
