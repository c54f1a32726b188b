// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/rotation_set.h"

#include "cook/animation_bounds/quaternion.h"
#include "formats/base/assert.h"

#include <cmath>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

constexpr std::array<std::array<int, 3>, kSlabCount> kSlabs{{{1, 0, 0},
                                                             {0, 1, 0},
                                                             {0, 0, 1},
                                                             {1, 1, 0},
                                                             {1, -1, 0},
                                                             {1, 0, 1},
                                                             {1, 0, -1},
                                                             {0, 1, 1},
                                                             {0, 1, -1},
                                                             {1, 1, 1},
                                                             {1, 1, -1},
                                                             {1, -1, 1},
                                                             {-1, 1, 1}}};

// Margin for the rounding of a projection, far above the error of double precision.
constexpr double kSlabMargin = 1e-9;

// Cosine between quaternions below which two rotations count as half a turn apart: either arc may be the
// shorter one.
constexpr double kMinCosine = 1e-5;

// Distance of quaternions from a common circle below which rotations are bounded as rotations about one axis.
constexpr double kNearCircle = 0.02;

// Maximum half width of a cell: control points then exceed the hull by less than a third.
constexpr double kMaxCellHalf = 0.4;

// Maximum extent of a projection. Larger sets are hardly smaller than the set of all rotations.
constexpr double kMaxExtent = 4;

// Maximum number of pairs that are tested one by one.
constexpr size_t kMaxPairs = 4'000'000;

double along(const std::array<int, 3>& direction, Double3 u)
{
    return direction[0] * u.x + direction[1] * u.y + direction[2] * u.z;
}

/// Return the principal directions of the points, irrespective of their signs.
Eigenvectors<4> principalDirections(std::span<const Quaternion> points)
{
    std::array<std::array<double, 4>, 4> sum{};
    for (const Quaternion& q : points)
    {
        const double weight = 1 / dot(q, q);
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = 0; j < 4; ++j)
                sum[i][j] += q[i] * q[j] * weight;
    }
    return eigenvectors(sum);
}

/// True if all points, each with the sign that brings it nearer to `center`, lie less than a quarter turn of
/// S3 apart. The shorter arc between any two of their blends then stays in their cone.
bool areInOneCone(std::span<const Quaternion> points, const Quaternion& center)
{
    // cosine, rounded up: two such points are less than a quarter turn apart
    constexpr double kEighthTurn = 0.7072;
    const auto cosine = [](const Quaternion& a, const Quaternion& b)
    { return dot(a, b) / (length(a) * length(b)); };
    double least = 1;
    for (const Quaternion& q : points)
        least = std::min(least, std::abs(cosine(q, center)));
    if (least >= kEighthTurn)
        return true;
    if (least < kMinCosine || points.size() * points.size() > kMaxPairs)
        return false;
    for (size_t i = 0; i < points.size(); ++i)
        for (size_t j = i + 1; j < points.size(); ++j)
        {
            const double sides = dot(points[i], center) * dot(points[j], center) < 0 ? -1 : 1;
            if (cosine(points[i], points[j]) * sides < kMinCosine)
                return false;
        }
    return true;
}

/// Return the gnomonic coordinates relative to a frame.
Double3 project(const Quaternion& frame, const Quaternion& q)
{
    const Quaternion turned = multiply(conjugate(frame), q);
    return Double3{turned[0], turned[1], turned[2]} * (1 / turned[3]);
}

Double3 unit(const std::array<double, 3>& v)
{
    return {v[0], v[1], v[2]};
}

/// Return the principal axes of vectors.
std::array<Double3, 3> principalAxes(std::span<const Double3> vectors)
{
    Double3 mean;
    for (const Double3 v : vectors)
        mean = mean + v * (1 / static_cast<double>(vectors.size()));
    Matrix3 sum{};
    for (const Double3 v : vectors)
    {
        const Double3 away = v - mean;
        const std::array<double, 3> a{away.x, away.y, away.z};
        for (size_t i = 0; i < 3; ++i)
            for (size_t j = 0; j < 3; ++j)
                sum[i][j] += a[i] * a[j];
    }
    const Eigenvectors<3> axes = eigenvectors(sum);
    return {unit(axes.vectors[0]), unit(axes.vectors[1]), unit(axes.vectors[2])};
}

std::vector<Double3> projectAll(const Quaternion& frame, std::span<const Quaternion> points)
{
    std::vector<Double3> vectors;
    vectors.reserve(points.size());
    for (const Quaternion& q : points)
        vectors.push_back(project(frame, q));
    return vectors;
}

Double3 inAxes(const std::array<Double3, 3>& axes, Double3 v)
{
    return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
}

Double3 fromAxes(const std::array<Double3, 3>& axes, Double3 u)
{
    return axes[0] * u.x + axes[1] * u.y + axes[2] * u.z;
}

Box3d patchBox(const RotationPatch& patch)
{
    return {patch.slabs[0], patch.slabs[1], patch.slabs[2]};
}

/// Return the patch of points that lie in one cone around the frame.
RotationPatch patchAround(const Quaternion& frame, std::span<const Quaternion> points)
{
    RotationPatch patch;
    patch.frame = frame;
    const std::vector<Double3> vectors = projectAll(frame, points);
    patch.axes = principalAxes(vectors);
    for (const Double3 v : vectors)
    {
        const Double3 u = inAxes(patch.axes, v);
        for (size_t s = 0; s < kSlabCount; ++s)
            patch.slabs[s].add(along(kSlabs[s], u));
    }
    for (Interval& slab : patch.slabs)
        slab.grow(kSlabMargin * (1 + slab.magnitude()));
    return patch;
}

/// Return a frame in the middle of the points, to keep rotations near the frame. The points lie in one cone
/// around `center`.
Quaternion middleFrame(const Quaternion& center, std::span<const Quaternion> points)
{
    const RotationPatch patch = patchAround(center, points);
    const Double3 u = fromAxes(patch.axes, middle(patchBox(patch)));
    return normalizedOrNone(multiply(center, {u.x, u.y, u.z, 1}));
}

/// Return a patch of half of a circle of S3 around `frame`, as wide in the other directions as the points
/// need.
RotationPatch halfCircle(const Quaternion& frame, const Quaternion& side, double beside)
{
    const Quaternion axis = multiply(conjugate(frame), side); // of a right angle: the real part is 0
    const Double3 a{axis[0], axis[1], axis[2]};
    const Double3 other = std::abs(a.x) < 0.6 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 b = cross(a, other) * (1 / length(cross(a, other)));
    RotationPatch patch;
    patch.frame = frame;
    patch.axes = {a, b, cross(a, b)};
    const Double3 extent{1 + 4 * beside, 4 * beside, 4 * beside};
    for (size_t s = 0; s < kSlabCount; ++s)
    {
        const double reach = std::abs(kSlabs[s][0]) * extent.x + std::abs(kSlabs[s][1]) * extent.y +
                             std::abs(kSlabs[s][2]) * extent.z + kSlabMargin;
        patch.slabs[s] = {-reach, reach};
    }
    return patch;
}

/// Return the maximum distance of the points, as unit quaternions, from the circle through two.
double distanceFromCircle(std::span<const Quaternion> points, const Quaternion& a, const Quaternion& b)
{
    double distance = 0;
    for (const Quaternion& q : points)
    {
        const double in_plane = (dot(q, a) * dot(q, a) + dot(q, b) * dot(q, b)) / dot(q, q);
        distance = std::max(distance, std::sqrt(std::max(0.0, 1 - in_plane)));
    }
    return distance;
}

/// Axis of a patch's box, divided into cells. Nodes alternate between ends of cells and their middles.
class AxisCells
{
public:
    AxisCells(const Interval& interval, double tolerance)
    {
        // a quaternion that turns by an angle changes the matrix by 2 sin(angle)
        if (2 * interval.half() <= tolerance)
        {
            first_ = interval.middle();
            slack_ = 2 * interval.half();
            return;
        }
        const double max_half = std::min(kMaxCellHalf, std::sqrt(tolerance * 0.5));
        cells_ = std::ceil(interval.half() / max_half);
        first_ = interval.low;
        half_ = interval.half() / cells_;
    }

    /// Return the number of nodes: an integer, but possibly beyond the range of integers.
    double nodeCount() const { return 2 * cells_ + 1; }
    size_t nodes() const { return static_cast<size_t>(nodeCount()); }
    double at(size_t node) const { return first_ + static_cast<double>(node) * half_; }
    /// Return half the width of the cell around a middle node; 0 for an end node.
    double halfAt(size_t node) const { return node % 2 == 1 ? half_ : 0.0; }
    /// Return the maximum distance between a node and a point of its cells.
    double reachAt(size_t node) const
    {
        return cells_ == 0 ? 0.5 * slack_ : node % 2 == 1 ? half_ : 2 * half_;
    }
    /// Return the operator norm of the error of an axis that is replaced by its middle.
    double slack() const { return slack_; }

private:
    double cells_ = 0;
    double first_ = 0;
    double half_ = 0;
    double slack_ = 0;
};

std::array<AxisCells, 3> makeCells(const RotationPatch& patch, double tolerance)
{
    return {AxisCells(patch.slabs[0], tolerance), AxisCells(patch.slabs[1], tolerance),
            AxisCells(patch.slabs[2], tolerance)};
}

double totalSlack(const std::array<AxisCells, 3>& cells)
{
    return cells[0].slack() + cells[1].slack() + cells[2].slack();
}

Matrix3 rotationMatrix(const Quaternion& unit_quaternion)
{
    const Affine3d t = makeAffineFromTrs({}, unit_quaternion, {1, 1, 1});
    return {{{t.m[0][0], t.m[0][1], t.m[0][2]},
             {t.m[1][0], t.m[1][1], t.m[1][2]},
             {t.m[2][0], t.m[2][1], t.m[2][2]}}};
}

/// Control points of a patch's matrices. The matrices are rational functions of u: |q|^2 R and |q|^2 are of
/// second degree in q = frame * (u, 1), so on each cell the matrices are in the convex hull of their
/// Bernstein coefficients' quotients.
/// source  G. Farin, "NURBS: from projective geometry to practical use", 1999 (rational Bezier patches)
class ControlPoints
{
public:
    explicit ControlPoints(const RotationPatch& patch) : patch_(patch)
    {
        for (size_t i = 0; i < 3; ++i)
        {
            const Double3 axis = patch.axes[i];
            axis_matrices_[i] = rotationMatrix(multiply(patch.frame, {axis.x, axis.y, axis.z, 0}));
        }
    }

    /// Return the control point of a node.
    /// u       a node of the lattice
    /// halves  half the width of the cell that u is the middle of, by axis; 0 where u is an end of a cell
    Matrix3 at(Double3 u, const std::array<double, 3>& halves) const
    {
        const Double3 v = fromAxes(patch_.axes, u);
        const double square = 1 + dot(u, u);
        Matrix3 sum = rotationMatrix(normalizedOrNone(multiply(patch_.frame, {v.x, v.y, v.z, 1})));
        double weight = square;
        for (const double half : halves)
            weight -= half * half;
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 3; ++column)
            {
                double value = square * sum[row][column];
                for (size_t axis = 0; axis < 3; ++axis)
                    value -= halves[axis] * halves[axis] * axis_matrices_[axis][row][column];
                sum[row][column] = value / weight;
            }
        return sum;
    }

private:
    const RotationPatch& patch_;
    std::array<Matrix3, 3> axis_matrices_;
};

/// True if a box of the lattice overlaps all slabs.
bool reachesInto(const RotationPatch& patch, Double3 center, Double3 extent)
{
    for (size_t s = 0; s < kSlabCount; ++s)
    {
        const double reach = std::abs(kSlabs[s][0]) * extent.x + std::abs(kSlabs[s][1]) * extent.y +
                             std::abs(kSlabs[s][2]) * extent.z;
        const double at = along(kSlabs[s], center);
        if (at + reach < patch.slabs[s].low || at - reach > patch.slabs[s].high)
            return false;
    }
    return true;
}

void addControlPoints(const RotationPatch& patch, double tolerance, RotationHull& hull)
{
    const std::array<AxisCells, 3> cells = makeCells(patch, tolerance);
    const ControlPoints points(patch);
    for (size_t i = 0; i < cells[0].nodes(); ++i)
        for (size_t j = 0; j < cells[1].nodes(); ++j)
            for (size_t k = 0; k < cells[2].nodes(); ++k)
            {
                const Double3 u{cells[0].at(i), cells[1].at(j), cells[2].at(k)};
                const Double3 reach{cells[0].reachAt(i), cells[1].reachAt(j), cells[2].reachAt(k)};
                if (reachesInto(patch, u, reach))
                    hull.matrices.push_back(
                        points.at(u, {cells[0].halfAt(i), cells[1].halfAt(j), cells[2].halfAt(k)}));
            }
    hull.slack = std::max(hull.slack, totalSlack(cells));
}

bool isNarrow(const RotationPatch& patch)
{
    return std::max({patch.slabs[0].magnitude(), patch.slabs[1].magnitude(), patch.slabs[2].magnitude()}) <=
           kMaxExtent;
}

} // namespace

RotationSet RotationSet::around(const RotationPoints& points)
{
    RotationSet set;
    if (points.unbounded)
        return set;
    HEARTH_ASSERT(!points.points.empty());
    const Eigenvectors<4> spread_of_points = principalDirections(points.points);
    const Quaternion& center = spread_of_points.vectors[0];
    if (areInOneCone(points.points, center))
    {
        const Quaternion frame = middleFrame(center, points.points);
        const RotationPatch patch =
            patchAround(areInOneCone(points.points, frame) ? frame : center, points.points);
        if (isNarrow(patch))
            set.patches_.push_back(patch);
        return set;
    }
    const Quaternion& side = spread_of_points.vectors[1];
    if (const double beside = distanceFromCircle(points.points, center, side); beside <= kNearCircle)
        set.patches_ = {halfCircle(center, side, beside), halfCircle(side, center, beside)};
    return set;
}

double RotationSet::hullSize(double tolerance) const
{
    double size = 0;
    for (const RotationPatch& patch : patches_)
    {
        const std::array<AxisCells, 3> cells = makeCells(patch, tolerance);
        if (totalSlack(cells) > 1)
            return 1;
        size += cells[0].nodeCount() * cells[1].nodeCount() * cells[2].nodeCount();
    }
    return std::max(size, 1.0);
}

RotationHull RotationSet::hull(double tolerance) const
{
    RotationHull hull;
    for (const RotationPatch& patch : patches_)
        addControlPoints(patch, tolerance, hull);
    // any rotation is within 1 of the matrix 0
    if (unbounded() || hull.slack > 1)
        return {{Matrix3{}}, 1};
    return hull;
}

} // namespace hearth::animation_bounds
