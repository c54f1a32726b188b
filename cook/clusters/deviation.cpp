// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/deviation.h"

#include "formats/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hearth::clusters
{

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Pieces are cut until they are this close to the largest distance that the group has anyway.
constexpr float kSlack = 1.1f;

// And not below this part of the size of their triangle: on a plane all distances are rounding.
constexpr float kFinest = 1.0f / 512.0f;

// Rounding of a distance between points in [-1, 1]^3: a few times 2^-23, with room.
constexpr float kRounding = 2e-6f;

constexpr size_t kLanes = 4;
constexpr size_t kMaxBlocks = 8;
constexpr size_t kMaxCandidates = kLanes * kMaxBlocks;
constexpr size_t kMaxPoints = 24;

using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneMask = int32_t __attribute__((vector_size(kLanes * sizeof(int32_t))));

Lanes all(float x)
{
    return Lanes{x, x, x, x};
}
Lanes minimum(Lanes a, Lanes b)
{
    return a < b ? a : b;
}
Lanes maximum(Lanes a, Lanes b)
{
    return a > b ? a : b;
}
Lanes clampToUnit(Lanes x)
{
    return minimum(maximum(x, all(0)), all(1));
}

struct Vector
{
    Lanes x, y, z;
};
Vector operator-(Vector a, Vector b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(Vector a, Lanes s)
{
    return {a.x * s, a.y * s, a.z * s};
}
Lanes dot(Vector a, Vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector all(Float3 p)
{
    return {all(p.x), all(p.y), all(p.z)};
}

/// A triangle with what the distance to it needs.
struct Facet
{
    Float3 a;
    Float3 ab;
    Float3 ac;
    float ab_ab, ab_ac, ac_ac;
    float inverse_det; ///< 0 for a needle: then only its edges count
    float inverse_ab, inverse_ac, inverse_bc;
};
static_assert(sizeof(Facet) == 64);

float inverseOr0(float x)
{
    return x > 0 ? 1.0f / x : 0.0f;
}

Facet makeFacet(Float3 a, Float3 b, Float3 c)
{
    Facet f{};
    f.a = a;
    f.ab = b - a;
    f.ac = c - a;
    f.ab_ab = hearth::dot(f.ab, f.ab);
    f.ab_ac = hearth::dot(f.ab, f.ac);
    f.ac_ac = hearth::dot(f.ac, f.ac);
    const float det = f.ab_ab * f.ac_ac - f.ab_ac * f.ab_ac;
    f.inverse_det = det > 1e-5f * f.ab_ab * f.ac_ac ? 1.0f / det : 0.0f;
    f.inverse_ab = inverseOr0(f.ab_ab);
    f.inverse_ac = inverseOr0(f.ac_ac);
    f.inverse_bc = inverseOr0(f.ab_ab - 2 * f.ab_ac + f.ac_ac);
    return f;
}

/// Several facets side by side.
struct FacetBlock
{
    Vector a, ab, ac;
    Lanes ab_ab, ab_ac, ac_ac, inverse_det, inverse_ab, inverse_ac, inverse_bc;

    /// Squared distances of a point. Each is the distance to some point of the facet, so never too small.
    Lanes distance2(Float3 point) const
    {
        const Vector ap = all(point) - a;
        const Lanes ab_ap = dot(ab, ap);
        const Lanes ac_ap = dot(ac, ap);
        const Vector to_ab = ap - ab * clampToUnit(ab_ap * inverse_ab);
        const Vector to_ac = ap - ac * clampToUnit(ac_ap * inverse_ac);
        const Vector bp = ap - ab;
        const Vector bc = ac - ab;
        const Vector to_bc = bp - bc * clampToUnit(dot(bp, bc) * inverse_bc);
        Lanes nearest = minimum(minimum(dot(to_ab, to_ab), dot(to_ac, to_ac)), dot(to_bc, to_bc));
        const Lanes v = (ac_ac * ab_ap - ab_ac * ac_ap) * inverse_det;
        const Lanes w = (ab_ab * ac_ap - ab_ac * ab_ap) * inverse_det;
        const LaneMask inside = (v >= all(0)) & (w >= all(0)) & (v + w <= all(1)) & (inverse_det > all(0));
        const Vector to_face = ap - ab * v - ac * w;
        const Lanes face = dot(to_face, to_face);
        return inside ? minimum(face, nearest) : nearest;
    }
};

template <typename Member>
Lanes gather(const std::array<const Facet*, kLanes>& f, Member member)
{
    return Lanes{member(*f[0]), member(*f[1]), member(*f[2]), member(*f[3])};
}

FacetBlock makeBlock(const std::array<const Facet*, kLanes>& f)
{
    const auto vector = [&](auto part)
    {
        return Vector{gather(f, [&](const Facet& facet) { return part(facet).x; }),
                      gather(f, [&](const Facet& facet) { return part(facet).y; }),
                      gather(f, [&](const Facet& facet) { return part(facet).z; })};
    };
    return {vector([](const Facet& facet) { return facet.a; }),
            vector([](const Facet& facet) { return facet.ab; }),
            vector([](const Facet& facet) { return facet.ac; }),
            gather(f, [](const Facet& facet) { return facet.ab_ab; }),
            gather(f, [](const Facet& facet) { return facet.ab_ac; }),
            gather(f, [](const Facet& facet) { return facet.ac_ac; }),
            gather(f, [](const Facet& facet) { return facet.inverse_det; }),
            gather(f, [](const Facet& facet) { return facet.inverse_ab; }),
            gather(f, [](const Facet& facet) { return facet.inverse_ac; }),
            gather(f, [](const Facet& facet) { return facet.inverse_bc; })};
}

/// A surface of the group: its facets, and those around each position.
struct Surface
{
    std::vector<Facet> facets;
    std::vector<std::array<uint32_t, 3>> positions; ///< of each facet
    std::vector<uint32_t> star_items;
    std::vector<uint32_t> star_offsets;

    std::span<const uint32_t> star(uint32_t position) const
    {
        return std::span(star_items)
            .subspan(star_offsets[position], star_offsets[position + 1] - star_offsets[position]);
    }
};

Surface makeSurface(const GroupMesh& group, std::span<const uint32_t> corners)
{
    Surface surface;
    const size_t count = corners.size() / 3;
    surface.facets.reserve(count);
    surface.positions.reserve(count);
    surface.star_offsets.assign(group.positions.size() + 1, 0);
    for (size_t t = 0; t < count; ++t)
    {
        std::array<uint32_t, 3> p;
        for (size_t k = 0; k < 3; ++k)
        {
            p[k] = group.position_of_wedge[corners[t * 3 + k]];
            ++surface.star_offsets[p[k] + 1];
        }
        surface.positions.push_back(p);
        surface.facets.push_back(
            makeFacet(group.positions[p[0]], group.positions[p[1]], group.positions[p[2]]));
    }
    for (size_t i = 1; i < surface.star_offsets.size(); ++i)
        surface.star_offsets[i] += surface.star_offsets[i - 1];
    surface.star_items.resize(count * 3);
    std::vector<uint32_t> next(surface.star_offsets.begin(), surface.star_offsets.end() - 1);
    for (uint32_t t = 0; t < count; ++t)
        for (const uint32_t p : surface.positions[t])
            surface.star_items[next[p]++] = t;
    return surface;
}

/// The facets that a triangle is held against.
class Candidates
{
public:
    void clear() { count_ = 0; }
    bool full() const { return count_ == kMaxCandidates; }
    size_t count() const { return count_; }

    void add(uint32_t facet)
    {
        if (full() || std::find(numbers_.begin(), numbers_.begin() + static_cast<ptrdiff_t>(count_), facet) !=
                          numbers_.begin() + static_cast<ptrdiff_t>(count_))
            return;
        numbers_[count_++] = facet;
    }

    /// Fill the blocks; lanes that are left over repeat the first facet.
    void load(const Surface& surface)
    {
        HEARTH_ASSERT(count_ > 0);
        block_count_ = (count_ + kLanes - 1) / kLanes;
        for (size_t b = 0; b < block_count_; ++b)
        {
            std::array<const Facet*, kLanes> facets;
            for (size_t lane = 0; lane < kLanes; ++lane)
                facets[lane] = &surface.facets[numbers_[b * kLanes + lane < count_ ? b * kLanes + lane : 0]];
            blocks_[b] = makeBlock(facets);
        }
    }

    std::span<const FacetBlock> blocks() const { return std::span(blocks_).first(block_count_); }

private:
    std::array<uint32_t, kMaxCandidates> numbers_;
    std::array<FacetBlock, kMaxBlocks> blocks_;
    size_t count_ = 0;
    size_t block_count_ = 0;
};

struct Probe
{
    Float3 place;
    std::array<Lanes, kMaxBlocks> distance2; ///< to each candidate
};

struct Nearest
{
    float distance2;
    size_t candidate;
};

class Bounder
{
public:
    /// Cut the triangle until each piece is within allowed2 of one candidate, or the points run out.
    /// Returns the bound of the whole triangle, squared.
    float bound(const std::array<Float3, 3>& triangle, const Candidates& candidates, float allowed2);

    uint64_t loosePieces() const { return loose_pieces_; }

private:
    using Piece = std::array<uint8_t, 3>;

    uint8_t addPoint(Float3 place, std::span<const FacetBlock> blocks)
    {
        Probe& probe = points_[point_count_];
        probe.place = place;
        for (size_t b = 0; b < blocks.size(); ++b)
            probe.distance2[b] = blocks[b].distance2(place);
        return static_cast<uint8_t>(point_count_++);
    }

    static Nearest reduce(std::span<const Lanes> values)
    {
        Nearest nearest{kInfinity, 0};
        for (size_t b = 0; b < values.size(); ++b)
            for (size_t lane = 0; lane < kLanes; ++lane)
                if (values[b][lane] < nearest.distance2)
                    nearest = {values[b][lane], b * kLanes + lane};
        return nearest;
    }

    /// The candidate that holds all the named points best.
    template <size_t N>
    Nearest common(const std::array<uint8_t, N>& names, size_t block_count) const
    {
        std::array<Lanes, kMaxBlocks> worst;
        for (size_t b = 0; b < block_count; ++b)
        {
            worst[b] = points_[names[0]].distance2[b];
            for (size_t i = 1; i < N; ++i)
                worst[b] = maximum(worst[b], points_[names[i]].distance2[b]);
        }
        return reduce(std::span(worst).first(block_count));
    }

    float distance2(uint8_t point, size_t candidate) const
    {
        return points_[point].distance2[candidate / kLanes][candidate % kLanes];
    }

    /// Where between two points the nearest candidate changes.
    float changePoint(uint8_t p, uint8_t q, size_t block_count) const
    {
        const size_t near_p = common<1>({p}, block_count).candidate;
        const size_t near_q = common<1>({q}, block_count).candidate;
        const float p_leaves = std::sqrt(distance2(p, near_q));
        const float q_leaves = std::sqrt(distance2(q, near_p));
        const float sum = p_leaves + q_leaves;
        return near_p == near_q || !(sum > 0) ? 0.5f : std::clamp(p_leaves / sum, 0.1f, 0.9f);
    }

    std::array<Probe, kMaxPoints> points_;
    size_t point_count_ = 0;
    std::array<Piece, 2 * kMaxPoints> stack_;
    uint64_t loose_pieces_ = 0;
};

float Bounder::bound(const std::array<Float3, 3>& triangle, const Candidates& candidates, float allowed2)
{
    const auto blocks = candidates.blocks();
    point_count_ = 0;
    Piece whole;
    for (size_t k = 0; k < 3; ++k)
        whole[k] = addPoint(triangle[k], blocks);
    size_t stack_size = 0;
    stack_[stack_size++] = whole;
    float result2 = 0;
    while (stack_size > 0)
    {
        const Piece piece = stack_[--stack_size];
        const float best2 = common(piece, blocks.size()).distance2;
        if (best2 <= std::max(allowed2, result2) || point_count_ == kMaxPoints)
        {
            loose_pieces_ += best2 > std::max(allowed2, result2) ? 1u : 0u;
            result2 = std::max(result2, best2);
            continue;
        }
        // cut the edge whose ends agree least on a candidate
        size_t cut_edge = 0;
        float cut_value = -1;
        float cut_length2 = -1;
        for (size_t k = 0; k < 3; ++k)
        {
            const std::array<uint8_t, 2> ends{piece[k], piece[(k + 1) % 3]};
            const float value = common(ends, blocks.size()).distance2;
            const Float3 along = points_[ends[1]].place - points_[ends[0]].place;
            const float length2 = hearth::dot(along, along);
            if (value > cut_value || (value == cut_value && length2 > cut_length2))
            {
                cut_edge = k;
                cut_value = value;
                cut_length2 = length2;
            }
        }
        const uint8_t p = piece[cut_edge];
        const uint8_t q = piece[(cut_edge + 1) % 3];
        const uint8_t apex = piece[(cut_edge + 2) % 3];
        const float t = changePoint(p, q, blocks.size());
        const uint8_t middle = addPoint(points_[p].place * (1 - t) + points_[q].place * t, blocks);
        stack_[stack_size++] = {p, middle, apex};
        stack_[stack_size++] = {middle, q, apex};
    }
    return result2;
}

/// One group being measured.
class Measure
{
public:
    Measure(const GroupMesh& group, const Simplified& simplified)
        : group_(group),
          simplified_(simplified),
          before_(makeSurface(group, group.corners)),
          after_(makeSurface(group, simplified.corners)),
          changed_before_(group.triangleCount(), 1),
          changed_after_(simplified.triangleCount(), 1),
          under_(simplified.triangleCount())
    {
        for (size_t t = 0; t < changed_after_.size(); ++t)
        {
            const uint32_t source = simplified.source_triangle[t];
            if (before_.positions[source] == after_.positions[t])
                changed_after_[t] = changed_before_[source] = 0;
        }
    }

    Deviation run()
    {
        placeRemoved();
        for (uint32_t t = 0; t < changed_before_.size(); ++t)
            if (changed_before_[t] != 0)
                boundBefore(t);
        for (uint32_t t = 0; t < changed_after_.size(); ++t)
            if (changed_after_[t] != 0)
                boundAfter(t);
        return {static_cast<double>(std::sqrt(worst2_)) + kRounding, bounder_.loosePieces()};
    }

private:
    /// Find the facet that each removed position lies on now. Their distances are the least that the group can have.
    void placeRemoved()
    {
        for (uint32_t p = 0; p < simplified_.target_of_position.size(); ++p)
        {
            const uint32_t target = simplified_.target_of_position[p];
            if (target == p || target == kPruned || before_.star(p).empty())
                continue;
            uint32_t nearest = 0;
            float nearest2 = kInfinity;
            const auto star = after_.star(target);
            for (size_t i = 0; i < star.size(); i += kLanes)
            {
                std::array<const Facet*, kLanes> facets;
                for (size_t lane = 0; lane < kLanes; ++lane)
                    facets[lane] = &after_.facets[star[std::min(i + lane, star.size() - 1)]];
                const Lanes distance2 = makeBlock(facets).distance2(group_.positions[p]);
                for (size_t lane = 0; lane < kLanes; ++lane)
                    if (distance2[lane] < nearest2)
                    {
                        nearest2 = distance2[lane];
                        nearest = star[std::min(i + lane, star.size() - 1)];
                    }
            }
            if (star.empty())
                continue;
            worst2_ = std::max(worst2_, nearest2);
            under_[nearest].push_back(p);
        }
    }

    std::array<Float3, 3> placesOf(const std::array<uint32_t, 3>& positions) const
    {
        return {group_.positions[positions[0]], group_.positions[positions[1]],
                group_.positions[positions[2]]};
    }

    void boundTriangle(const std::array<Float3, 3>& triangle, const Surface& surface)
    {
        const Float3 e1 = triangle[1] - triangle[0];
        const Float3 e2 = triangle[2] - triangle[0];
        const float size2 = std::max(hearth::dot(e1, e1), hearth::dot(e2, e2));
        const float allowed2 = std::max(worst2_ * kSlack * kSlack, size2 * kFinest * kFinest);
        candidates_.load(surface);
        worst2_ = std::max(worst2_, bounder_.bound(triangle, candidates_, allowed2));
    }

    void boundBefore(uint32_t triangle)
    {
        candidates_.clear();
        for (const uint32_t p : before_.positions[triangle])
        {
            const uint32_t target = simplified_.target_of_position[p];
            if (target != kPruned && target != p)
                for (const uint32_t facet : after_.star(target))
                    candidates_.add(facet);
        }
        if (candidates_.count() == 0)
            addNearest(placesOf(before_.positions[triangle]));
        boundTriangle(placesOf(before_.positions[triangle]), after_);
    }

    void boundAfter(uint32_t triangle)
    {
        candidates_.clear();
        for (const uint32_t p : under_[triangle])
            for (const uint32_t facet : before_.star(p))
                candidates_.add(facet);
        for (const uint32_t p : after_.positions[triangle])
            for (const uint32_t facet : before_.star(p))
                candidates_.add(facet);
        boundTriangle(placesOf(after_.positions[triangle]), before_);
    }

    /// For a triangle whose island is gone: the facets that are left with the nearest corners.
    void addNearest(const std::array<Float3, 3>& triangle)
    {
        std::array<std::pair<float, uint32_t>, kLanes> nearest;
        nearest.fill({kInfinity, 0});
        const Float3 center = (triangle[0] + triangle[1] + triangle[2]) / 3.0f;
        for (uint32_t f = 0; f < after_.facets.size(); ++f)
        {
            const Float3 away =
                after_.facets[f].a + (after_.facets[f].ab + after_.facets[f].ac) / 3.0f - center;
            const std::pair<float, uint32_t> entry{hearth::dot(away, away), f};
            if (entry < nearest.back())
            {
                nearest.back() = entry;
                std::sort(nearest.begin(), nearest.end());
            }
        }
        for (const auto& [distance2, facet] : nearest)
            candidates_.add(facet);
    }

    const GroupMesh& group_;
    const Simplified& simplified_;
    Surface before_;
    Surface after_;
    std::vector<uint8_t> changed_before_;
    std::vector<uint8_t> changed_after_;
    std::vector<std::vector<uint32_t>> under_; ///< removed positions that lie on each facet
    float worst2_ = 0;
    Candidates candidates_;
    Bounder bounder_;
};

} // namespace

Deviation boundDeviation(const GroupMesh& group, const Simplified& simplified)
{
    HEARTH_ASSERT(simplified.triangleCount() > 0);
    return Measure(group, simplified).run();
}

} // namespace hearth::clusters
