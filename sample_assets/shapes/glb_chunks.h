// Collects the two chunks of a GLB file while it is written.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/json/json.h"

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace hearth::samples
{

inline constexpr int kComponentF32 = 5126; ///< component type of accessors

/// JSON and binary chunk under construction.
struct Glb
{
    Json json;
    std::vector<std::byte> binary;
    std::set<std::string> extensions; ///< extensions used; none is required to draw something sensible

    int addView(std::span<const std::byte> bytes, int target = 0)
    {
        binary.resize((binary.size() + 3) / 4 * 4);
        Json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (target != 0)
            view["target"] = target;
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        json["bufferViews"].push_back(std::move(view));
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    template <typename T>
    int addAccessor(std::span<const T> values, int component, const char* type, int target,
                    const Json& bounds = Json())
    {
        Json accessor{{"bufferView", addView(std::as_bytes(values), target)},
                      {"componentType", component},
                      {"count", values.size()},
                      {"type", type}};
        if (!bounds.is_null())
            accessor.update(bounds);
        json["accessors"].push_back(std::move(accessor));
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    void use(Json& object, const char* extension, Json value)
    {
        object["extensions"][extension] = std::move(value);
        extensions.insert(extension);
    }
};

} // namespace hearth::samples
