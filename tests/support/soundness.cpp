// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/soundness.h"

#include "tests/support/cuts.h"
#include "tests/support/sanitized.h"

#include <cmath>

namespace hearth::cuts
{

namespace
{

/// Part of the diagonal of the source's box that no level may be beyond it.
constexpr double kMaxOvershoot = 0.1;

} // namespace

std::string unsoundness(const mesh::SourceMesh& mesh, const clusters::Hierarchy& hierarchy,
                        std::span<const mesh::SourceMesh> authored)
{
    if (const Status valid = clusters::validateHierarchy(mesh, hierarchy, authored); !valid.ok())
        return formatMessage(valid.error());
    if (authored.empty() && !hierarchy.clusters.empty())
        if (const Overshoot overshoot = measureOvershoot(hierarchy); overshoot.part > kMaxOvershoot)
            return "level " + std::to_string(overshoot.level) + " leaves the box of the source";
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    if (!decoded.ok())
        return formatMessage(decoded.error());
    const Boundary source = findSourceBoundary(hierarchy, *decoded);
    const auto crack = [&](const std::vector<uint8_t>& replaced)
    { return findCrack(source, findBoundary(trianglesOfCut(hierarchy, *decoded, replaced))); };

    for (size_t l = 0; l < hierarchy.levels.size(); ++l)
        if (const std::string found = crack(cutAtError(hierarchy, hierarchy.levels[l].max_error));
            !found.empty())
            return "cut at level " + std::to_string(l) + ": " + found;
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    const Float3 middle = hierarchy.mesh.box_min * 0.5f + hierarchy.mesh.box_max * 0.5f;
    const Float3 half = hierarchy.mesh.box_max * 0.5f - hierarchy.mesh.box_min * 0.5f;
    for (int i = 0; i < 8; i += test::kSanitized ? 4 : 1)
    {
        if (const std::string found = crack(randomCut(hierarchy, 0.5 + 0.06 * i, random)); !found.empty())
            return "random cut " + std::to_string(i) + ": " + found;
        const Float3 eye = middle + half * Float3{uniform(), uniform(), uniform()} * 2.0f;
        if (const std::string found = crack(cutFromEye(hierarchy, eye, std::pow(10.0, -0.5 * i)));
            !found.empty())
            return "cut from eye " + std::to_string(i) + ": " + found;
    }
    return "";
}

} // namespace hearth::cuts
