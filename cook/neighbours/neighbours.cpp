// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/neighbours/neighbours.h"

#include "cook/json/json.h"
#include "cook/mesh/triangle_tree.h"
#include "formats/base/double3.h"
#include "formats/scene/asset_placement.h"

#include <fmt/format.h>

namespace hearth::neighbours
{

namespace
{

/// True if a source can occlude enough of another one. A ball around `occluder` of radius r, seen from a
/// point at a distance D from its centre, occludes at most (r / D)^2.
bool occludes(const Box3& occluder, const Box3& other)
{
    const Double3 diagonal = widen(occluder.max) - widen(occluder.min);
    const Double3 center = (widen(occluder.min) + widen(occluder.max)) * 0.5;
    return dot(diagonal, diagonal) * 0.25 >= kMaxOcclusionLeftOut * mesh::boxDistance2(center, other);
}

Float3 parsePoint(const Json& json)
{
    const auto numbers = json.get<std::vector<float>>();
    return numbers.size() == 3 ? Float3{numbers[0], numbers[1], numbers[2]}
                               : throw JsonError("a point has three numbers");
}

} // namespace

Neighbours findNeighbours(std::span<const Box3> boxes)
{
    Neighbours neighbours(boxes.size());
    std::vector<uint32_t> drawn;
    std::vector<Box3> drawn_boxes;
    for (uint32_t source = 0; source < boxes.size(); ++source)
        if (!boxes[source].empty())
        {
            drawn.push_back(source);
            drawn_boxes.push_back(boxes[source]);
        }
    if (formats::areUnplaced(drawn_boxes))
        return neighbours;
    for (const uint32_t source : drawn)
        for (const uint32_t other : drawn)
            if (other != source && occludes(boxes[other], boxes[source]))
                neighbours[source].push_back(other);
    return neighbours;
}

std::string neighboursText(const Neighbours& neighbours)
{
    std::string text;
    for (const std::vector<uint32_t>& of_source : neighbours)
        text += fmt::format("{}\n", fmt::join(of_source, " "));
    return text;
}

Result<Box3> parseBox(std::string_view import_statistics, const std::string& file)
{
    const std::optional<Json> json = Json::parse(import_statistics);
    // the JSON reader throws where a member is missing or of another type
    try
    {
        if (json)
        {
            const Json& box = json->at("lit_box");
            return box.is_null() ? Box3{} : Box3{parsePoint(box.at("min")), parsePoint(box.at("max"))};
        }
    }
    catch (const JsonError&)
    {
        return Error{Issue::json_syntax, file, "/lit_box", ""};
    }
    return Error{Issue::json_syntax, file, "", ""};
}

} // namespace hearth::neighbours
