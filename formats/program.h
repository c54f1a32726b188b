// How a program of Hearth ends when something is thrown.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"

#include <cstdio>
#include <exception>
#include <new>

namespace hearth
{

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
        const Error error{Issue::out_of_memory, name, "", ""};
        std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
        return exitCode(error);
    }
    catch (const std::exception& exception)
    {
        const Error error{Issue::internal, name, "", exception.what()};
        std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
        return exitCode(error);
    }
}

} // namespace hearth
