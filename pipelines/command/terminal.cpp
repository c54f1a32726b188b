// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/terminal.h"

#include <cstdlib>
#include <fmt/format.h>
#include <unistd.h>

namespace hearth::command
{

namespace
{

/// The environment's word for yes: set, and neither empty nor 0.
bool isSet(const char* name)
{
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0' && std::string_view(value) != "0";
}

ColorWish& wish()
{
    static ColorWish wish = ColorWish::automatic;
    return wish;
}

bool decideColor()
{
    if (wish() != ColorWish::automatic)
        return wish() == ColorWish::always;
    if (isSet("NO_COLOR"))
        return false;
    if (isSet("CLICOLOR_FORCE"))
        return true;
    const char* terminal = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && !isSet("CI") && terminal != nullptr &&
           std::string_view(terminal) != "dumb";
}

} // namespace

void setColor(ColorWish chosen)
{
    wish() = chosen;
}

bool colorOnStderr()
{
    static const bool color = decideColor();
    return color;
}

std::string faint(std::string_view text)
{
    return colorOnStderr() ? fmt::format("\033[2m{}\033[0m", text) : std::string(text);
}

std::string readableSize(uint64_t bytes)
{
    if (bytes < 1024)
        return fmt::format("{} B", bytes);
    const char* const units[] = {"KiB", "MiB", "GiB", "TiB"};
    double size = static_cast<double>(bytes) / 1024;
    size_t unit = 0;
    for (; size >= 1024 && unit + 1 < std::size(units); ++unit)
        size /= 1024;
    return fmt::format("{:.1f} {}", size, units[unit]);
}

} // namespace hearth::command
