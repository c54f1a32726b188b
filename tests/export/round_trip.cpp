// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/export/round_trip.h"

namespace hearth::test
{

using formats::PackView;

RoundTrip::RoundTrip(const std::string& source, const std::vector<std::string>& options,
                     const std::vector<std::string>& second_options)
{
    const auto cook =
        [&](const std::string& from, const std::string& to, const std::vector<std::string>& words)
    {
        std::vector<std::string> command{HEARTH_BIN "/hearth", "cook",       from,  "-o", to,
                                         "--no-cache",         "--progress", "none"};
        command.insert(command.end(), words.begin(), words.end());
        return run(command);
    };
    if (cook(source, firstPath(), options) &&
        run({HEARTH_BIN "/hearth", "extract", firstPath(), "-o", glbPath()}) &&
        cook(glbPath(), secondPath(), second_options))
    {
        first_ = open(firstPath());
        second_ = open(secondPath());
    }
}

bool RoundTrip::run(const std::vector<std::string>& command)
{
    const ProgramEnd end = folder_.run(command);
    if (command[1] == "extract")
        printed_ = end.out;
    if (end.exit_code != 0)
        fault_ = command[1] + " ended with " + std::to_string(end.exit_code) + ": " + end.err;
    return end.exit_code == 0;
}

std::unique_ptr<PackView> RoundTrip::open(const std::string& path)
{
    auto reader = formats::ContainerReader::open(path);
    auto view = reader.ok() ? PackView::read(std::move(*reader)) : Result<PackView>(reader.error());
    if (!view.ok())
        fault_ = formatMessage(view.error());
    return view.ok() ? std::make_unique<PackView>(std::move(*view)) : nullptr;
}

std::vector<std::string> makeOptions(const std::string& families)
{
    return {"--set", "textures.families=[" + families + "]", "--visibility", "off", "--bricks", "off"};
}

} // namespace hearth::test
