// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/call.h"

#include <algorithm>
#include <cstring>

namespace hearth::c
{

namespace
{

hearth_result resultFromError(const Error& error)
{
    switch (error.issue)
    {
    case Issue::device:
        return HEARTH_ERROR_DEVICE;
    case Issue::device_failed:
        return HEARTH_ERROR_DEVICE_FAILED;
    case Issue::device_limit:
        return HEARTH_ERROR_DEVICE_LIMIT;
    case Issue::device_lost:
        return HEARTH_ERROR_DEVICE_LOST;
    case Issue::device_memory:
        return HEARTH_ERROR_OUT_OF_DEVICE_MEMORY;
    case Issue::streaming_budget:
        return HEARTH_ERROR_STREAMING_BUDGET;
    case Issue::out_of_memory:
        return HEARTH_ERROR_OUT_OF_MEMORY;
    default:
        break;
    }
    switch (issueInfo(error.issue).kind)
    {
    case IssueClass::usage:
        return HEARTH_ERROR_USAGE;
    case IssueClass::missing:
        return HEARTH_ERROR_FILE_MISSING;
    case IssueClass::malformed:
        return HEARTH_ERROR_FILE_MALFORMED;
    case IssueClass::io:
        return HEARTH_ERROR_READ;
    default:
        return HEARTH_ERROR_INTERNAL;
    }
}

/// Text of an error without the hint of Issue::usage, which is about the command line and no help to a
/// program.
std::string formatCallError(const char* function, const Error& error)
{
    if (error.issue != Issue::usage)
        return formatMessage(error);
    return function + (error.where.empty() ? "" : "|" + error.where) + ": error: " + error.detail +
           " [E1000] hint: see hearth.h";
}

/// "2 scenes and 1 player are alive [E1000] hint: destroy them before the pack".
std::string inUseText(std::initializer_list<LiveObjectCount> objects, const char* owner)
{
    std::string list;
    uint32_t total = 0;
    for (const LiveObjectCount& kind : objects)
    {
        total += kind.count;
        if (kind.count > 0)
            list += (list.empty() ? "" : " and ") + std::to_string(kind.count) + " " +
                    (kind.count == 1 ? kind.one : kind.several);
    }
    return list +
           (total == 1 ? " is alive [E1000] hint: destroy it before the "
                       : " are alive [E1000] hint: destroy them before the ") +
           owner;
}

void write(MessageBuffer message, const char* text, size_t length)
{
    if (message.text == nullptr || message.size == 0)
        return;
    const size_t copied = std::min(length, message.size - 1);
    std::memcpy(message.text, text, copied);
    message.text[copied] = '\0';
}

/// Return the text that `make` returns, or the string of the result if there is no memory for it.
template <typename Make>
void writeText(MessageBuffer message, hearth_result result, const Make& make) noexcept
try
{
    const std::string text = make();
    write(message, text.data(), text.size());
}
catch (const std::bad_alloc&)
{
    const char* text = hearth_result_string(result);
    write(message, text, std::strlen(text));
}

} // namespace

Error usage(std::string detail)
{
    return {Issue::usage, "", "", std::move(detail)};
}

hearth_result fail(MessageBuffer message, const char* function, const Error& error)
{
    const hearth_result result = resultFromError(error);
    writeText(message, result, [&] { return formatCallError(function, error); });
    return result;
}

hearth_result checkUnused(MessageBuffer message, const char* function, const char* owner,
                          std::initializer_list<LiveObjectCount> objects) noexcept
{
    if (std::all_of(objects.begin(), objects.end(),
                    [](const LiveObjectCount& kind) { return kind.count == 0; }))
        return HEARTH_OK;
    writeText(message, HEARTH_ERROR_IN_USE,
              [&] { return std::string(function) + ": error: " + inUseText(objects, owner); });
    return HEARTH_ERROR_IN_USE;
}

Status checkStruct(const char* name, const uint32_t* struct_size, size_t expected_size)
{
    if (struct_size == nullptr)
        return usage(std::string(name) + " is NULL");
    if (*struct_size != expected_size)
        return usage(std::string(name) + " has a struct_size of " + std::to_string(*struct_size) +
                     ", this version of the library knows " + std::to_string(expected_size) +
                     ": begin with its HEARTH_..._INIT, and compile with the hearth.h of the library");
    return success();
}

} // namespace hearth::c

uint32_t hearth_api_version(void)
{
    return HEARTH_API_VERSION;
}

const char* hearth_result_string(hearth_result result)
{
    switch (result)
    {
    case HEARTH_OK:
        return "ok";
    case HEARTH_ERROR_USAGE:
        return "an argument or the order of calls is wrong";
    case HEARTH_ERROR_IN_USE:
        return "what was made from it has not been destroyed";
    case HEARTH_ERROR_FILE_MISSING:
        return "a file cannot be read";
    case HEARTH_ERROR_FILE_MALFORMED:
        return "a file is damaged, or of another kind or version";
    case HEARTH_ERROR_READ:
        return "reading failed";
    case HEARTH_ERROR_DEVICE:
        return "the graphics device lacks what is needed";
    case HEARTH_ERROR_DEVICE_FAILED:
        return "the graphics device failed";
    case HEARTH_ERROR_DEVICE_LIMIT:
        return "too large for the graphics device";
    case HEARTH_ERROR_STREAMING_BUDGET:
        return "the geometry that must stay in memory exceeds the budget";
    case HEARTH_ERROR_OUT_OF_MEMORY:
        return "out of memory";
    case HEARTH_ERROR_INTERNAL:
        return "a defect of Hearth";
    case HEARTH_ERROR_DEVICE_LOST:
        return "the graphics device was lost";
    case HEARTH_ERROR_OUT_OF_DEVICE_MEMORY:
        return "out of memory of the graphics device";
    default:
        return "not a result of this version";
    }
}
