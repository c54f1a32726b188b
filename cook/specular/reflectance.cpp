// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/reflectance.h"

#include "cook/specular/lobe.h"
#include "formats/base/half.h"
#include "formats/gpu_shared/reflectance.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hearth::specular
{

namespace
{

// Radians. The mean direction of a lobe seen along the normal is the normal, and its turn the limit of nearby
// views.
constexpr double kMinTilt = 0.02;

/// Return the share by which the mean direction is turned from R to N: it is (1 - turn) R + turn N.
double computeTurn(const Lobe& lobe, const Double3& mean)
{
    const double slope = mean.x / mean.z;
    const double from_normal = std::sin(lobe.theta_o) - slope * std::cos(lobe.theta_o);
    return std::clamp(from_normal / (from_normal + slope), 0.0, 1.0);
}

/// Return the cosine of the half-angle of the cone that represents a lobe. A cone with the lobe's mean
/// direction has 2 |mean| - 1. Smooth lobes of GGX have a narrow core and long tails, so that they need a
/// narrower one: the share has the least error under a sky with a horizon, over random views.
double computeCosHalfAngle(const Lobe& lobe, const Double3& mean)
{
    const double share = 0.55 + 0.45 * lobe.roughness;
    return std::max(1 - share * (2 - 2 * length(mean)), 0.0);
}

} // namespace

std::vector<uint64_t> cookReflectance()
{
    std::vector<uint64_t> table;
    for (uint32_t row = 0; row < shared::kReflectanceRows; ++row)
        for (uint32_t column = 0; column < shared::kReflectanceColumns; ++column)
        {
            const Float2 node = shared::reflectanceNode(column, row);
            const Lobe lobe{.roughness = double{node.y},
                            .theta_o = std::max(std::acos(double{node.x}), kMinTilt)};
            const LobeMoments moments = computeMoments(lobe);
            uint64_t word = 0;
            for (const double value : {computeCosHalfAngle(lobe, moments.mean),
                                       computeTurn(lobe, moments.mean), moments.bias, moments.scale})
                word = word << 16 | halfFromFloat(static_cast<float>(value));
            table.push_back(word);
        }
    return table;
}

std::string formatTable(const std::vector<uint64_t>& table, std::string_view name, std::string_view comment)
{
    constexpr size_t kInLine = 5;
    std::string text = fmt::format("{}"
                                   "// SPDX-License-Identifier: LicenseRef-Hearth-Undecided\n"
                                   "#pragma once\n\n"
                                   "#include <array>\n"
                                   "#include <cstdint>\n\n"
                                   "namespace hearth::shared\n{{\n\n"
                                   "// clang-format off\n",
                                   comment);
    text += fmt::format("inline constexpr std::array<uint64_t, {}> {}{{", table.size(), name);
    for (size_t i = 0; i < table.size(); ++i)
        text += fmt::format("{}0x{:016X},", i % kInLine == 0 ? "\n    " : " ", table[i]);
    return text + "};\n// clang-format on\n\n} // namespace hearth::shared\n";
}

} // namespace hearth::specular
