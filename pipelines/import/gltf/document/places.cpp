// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/places.h"

#include "cook/json/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hearth::import
{

namespace
{

// as many as fit a line of a terminal
constexpr size_t kMaxNamedPlaces = 4;

} // namespace

std::string JsonPath::pointer() const
{
    std::vector<std::string> steps;
    for (const JsonPath* path = this; path->parent != nullptr; path = path->parent)
        steps.push_back(path->parent->value.isArray() ? fmt::format("/{}", path->index)
                                                      : pointerStep(path->value.key()));
    return fmt::format("{}", fmt::join(steps.rbegin(), steps.rend(), ""));
}

void PlaceList::add(const JsonPath& path)
{
    if (count_++ < kMaxNamedPlaces)
        pointers_.push_back(path.pointer());
}

std::string PlaceList::list() const
{
    if (count_ < 2)
        return "";
    if (count_ > pointers_.size())
        return fmt::format(" ({} places: {} and {} more)", count_, fmt::join(pointers_, ", "),
                           count_ - pointers_.size());
    return fmt::format(" ({} places: {} and {})", count_,
                       fmt::join(pointers_.begin(), pointers_.end() - 1, ", "), pointers_.back());
}

} // namespace hearth::import
