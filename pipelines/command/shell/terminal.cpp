// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/terminal.h"

#include "pipelines/profiles/command_settings.h"
#include "pipelines/profiles/configuration.h"

#include <fmt/format.h>
#include <unistd.h>

namespace hearth::command
{

namespace
{

ColorChoice& choice()
{
    static ColorChoice choice = ColorChoice::automatic;
    return choice;
}

bool decideColor()
{
    if (choice() != ColorChoice::automatic)
        return choice() == ColorChoice::always;
    using namespace profiles;
    if (const settings::EnvironmentSwitch* chosen =
            findSetSwitch(*settings::findSetting(commandSettings(), "color")))
        return chosen->value == "always";
    const bool is_automatic_build = processEnvironment("CI").value_or("0") != "0";
    return ::isatty(STDERR_FILENO) == 1 && !is_automatic_build &&
           processEnvironment("TERM").value_or("dumb") != "dumb";
}

} // namespace

void setColorChoice(ColorChoice chosen)
{
    choice() = chosen;
}

bool isStderrColored()
{
    static const bool color = decideColor();
    return color;
}

std::string faint(std::string_view text)
{
    return isStderrColored() ? fmt::format("\033[2m{}\033[0m", text) : std::string(text);
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
