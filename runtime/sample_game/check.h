// Ends the game with one line of text if a call has failed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdio>
#include <cstdlib>
#include <hearth.hpp>
#include <string>

namespace game
{

inline void check(bool is_good, const std::string& why)
{
    if (is_good)
        return;
    std::fprintf(stderr, "game: %s\n", why.c_str());
    std::exit(1);
}

inline void check(VkResult result)
{
    check(result >= 0, "Vulkan says " + std::to_string(result));
}

inline void check(hearth_result result, const std::string& message)
{
    check(result == HEARTH_OK, message.empty() ? hearth_result_string(result) : message);
}

} // namespace game
