// Shared helpers of the pack checker. Not for use outside formats/.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_check.h"

#include <cmath>

namespace hearth::formats::check
{

/// Return the error of record `index` of a table: where = "node 3".
inline Error makeError(const PackView& view, Issue issue, const char* kind, size_t index, std::string detail)
{
    return {issue, view.name(), std::string(kind) + " " + std::to_string(index), std::move(detail)};
}

inline bool finite(float value)
{
    return std::isfinite(value);
}
inline bool finite(Float2 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y);
}
inline bool finite(Float3 v)
{
    return hearth::isFinite(v);
}
inline bool finite(Float4 v)
{
    return finite(Float3{v.x, v.y, v.z}) && std::isfinite(v.w);
}
inline bool finite(std::span<const float> values)
{
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}
inline bool finite(const Affine3& t)
{
    return finite(t.m[0]) && finite(t.m[1]) && finite(t.m[2]);
}

/// True if `low` is nowhere above `high`, and both are finite.
inline bool isValidBox(Float3 low, Float3 high)
{
    return finite(low) && finite(high) && low.x <= high.x && low.y <= high.y && low.z <= high.z;
}

/// True if the value is finite and inside [low, high].
inline bool inside(float value, float low, float high)
{
    return value >= low && value <= high;
}
inline bool isNonNegative(float value)
{
    return std::isfinite(value) && value >= 0;
}

/// pi / 2 rounded up to a float, plus one unit in the last place for a writer's conversion from degrees.
inline constexpr float kRightAngle = 1.5707965f;

inline bool isPowerOfTwo(float value)
{
    int exponent;
    return std::isfinite(value) && std::frexp(value, &exponent) == 0.5f;
}

inline bool isNoneOrBelow(uint32_t index, size_t size)
{
    return index == kInvalidIndex || index < size;
}

template <typename T, size_t N>
bool reservedZero(const T (&words)[N])
{
    return std::all_of(std::begin(words), std::end(words), [](T word) { return word == 0; });
}

/// RangeCursor over a table. The records of another table must claim its records as consecutive ranges.
class RangeCursor
{
public:
    RangeCursor(const PackView& view, const char* owner, const char* table, size_t size)
        : view_(view), owner_(owner), table_(table), size_(size)
    {
    }

    /// Claim a range. errors: meaning_range if it leaves the table, meaning_order if it does not follow the
    /// last range.
    Status take(size_t owner, Range range)
    {
        if (!isInsideTable(range, size_))
            return makeError(view_, Issue::meaning_range, owner_, owner,
                             std::string(table_) + " " + std::to_string(range.first) + " + " +
                                 std::to_string(range.count) + " of " + std::to_string(size_));
        if (range.first != at_)
            return makeError(view_, Issue::meaning_order, owner_, owner,
                             std::string(table_) + " start at " + std::to_string(range.first) +
                                 ", expected " + std::to_string(at_));
        at_ += range.count;
        return success();
    }

    /// Return the first unclaimed record.
    size_t at() const { return at_; }

    /// Check that all records are claimed. errors: meaning_range
    Status finish() const
    {
        if (at_ == size_)
            return success();
        return makeError(view_, Issue::meaning_range, table_, at_, std::string("belongs to no ") + owner_);
    }

private:
    const PackView& view_;
    const char* owner_;
    const char* table_;
    size_t size_;
    size_t at_ = 0;
};

/// Option to read or skip the bulk of a pack: texels, geometry pages, and the padding around them.
enum class BulkData
{
    read,
    skip,
};

/// Return the number of joints of each mesh's skin. Unknown in a part without nodes.
std::vector<uint32_t> jointCounts(const PackView& view);

/// Check a decoded page. The tables of the view have been checked; `joint_count` is of its mesh's skin.
Status checkPage(const PackView& view, uint32_t page_index, std::span<const std::byte> page,
                 uint32_t joint_count);

// Phases of checkPack, in order.
Status checkTexts(const PackView& view);
Status checkMaterials(const PackView& view);
Status checkImages(const PackView& view, BulkData bulk);
Status checkSkins(const PackView& view);
Status checkAnimations(const PackView& view);
Status checkNodeTree(const PackView& view);
Status checkNodeMeshes(const PackView& view);
Status checkInstances(const PackView& view);
Status checkCameras(const PackView& view);
Status checkLights(const PackView& view);
Status checkShadowSpheres(const PackView& view);
Status checkMeshTables(const PackView& view);
Status checkPageTables(const PackView& view, BulkData bulk);
Status checkPageGeometry(const PackView& view, const PageLoop& loop);
Status checkAuthoredLevels(const PackView& view);
Status checkDeformedMeshes(const PackView& view);
Status checkAssets(const PackView& view);
Status checkExtras(const PackView& view);
Status checkSpecularTable(const PackView& view);
Status checkProbeTables(const PackView& view);
Status checkReceiverTables(const PackView& view);
Status checkReceiverReferences(const PackView& view);
/// Check that the faces that are receivers are those of the grid, which is checked.
Status checkFaceReferences(const PackView& view);
Status checkProxyTables(const PackView& view);
Status checkProxyReferences(const PackView& view);
Status checkSurroundings(const PackView& view);
Status checkBrickTables(const PackView& view);

} // namespace hearth::formats::check
