// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/interior.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::bricks
{

namespace
{

/// Place where the middle line of a column passes a triangle.
struct Crossing
{
    size_t column;
    double z;
    int turn; ///< 1 or -1, by the side of the triangle
};

/// Return on which side of the line from a to b a column's middle is, seen along z: 1 or -1. The line from b
/// to a has the other sign, whatever is rounded, so that a column between two triangles passes one of them.
int findSide(const Double3& a, const Double3& b, double x, double y)
{
    if (b.x < a.x || (b.x == a.x && b.y < a.y))
        return -findSide(b, a, x, y);
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) >= 0 ? 1 : -1;
}

bool isFinite(const Double3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Return the columns, from the first to one behind the last, whose middles lie between two coordinates.
std::array<uint32_t, 2> columnsBetween(double low, double high, uint32_t size)
{
    const auto near = [&](double place)
    { return static_cast<uint32_t>(std::clamp(place, 0.0, static_cast<double>(size))); };
    return {near(std::ceil(low - 0.5)), near(std::floor(high - 0.5) + 1)};
}

/// Triangle seen along z.
class FlatTriangle
{
public:
    FlatTriangle(const Double3& a, const Double3& b, const Double3& c) : a_(a), b_(b), c_(c) {}

    std::array<uint32_t, 2> columnsX(uint32_t size) const
    {
        const auto [low, high] = std::minmax({a_.x, b_.x, c_.x});
        return columnsBetween(low, high, size);
    }
    std::array<uint32_t, 2> columnsY(uint32_t size) const
    {
        const auto [low, high] = std::minmax({a_.y, b_.y, c_.y});
        return columnsBetween(low, high, size);
    }

    /// Return the side from which the line at (x, y) passes the triangle; 0 if it passes beside it.
    int findTurn(double x, double y) const
    {
        const int side = findSide(a_, b_, x, y);
        return side == findSide(b_, c_, x, y) && side == findSide(c_, a_, x, y) ? side : 0;
    }

    /// Return the height of the triangle at (x, y).
    double heightAt(double x, double y) const
    {
        const auto weight = [&](const Double3& p, const Double3& q)
        { return (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x); };
        const double of_a = weight(b_, c_), of_b = weight(c_, a_), of_c = weight(a_, b_);
        const double sum = of_a + of_b + of_c;
        return sum == 0 ? (a_.z + b_.z + c_.z) / 3 : (of_a * a_.z + of_b * b_.z + of_c * c_.z) / sum;
    }

private:
    Double3 a_, b_, c_;
};

/// Return the runs between crossings of one column, which are sorted.
void appendRuns(std::span<const Crossing> crossings, uint32_t size, CsrLists<Interior::Run>& runs)
{
    const auto firstMiddleFrom = [&](double z)
    { return static_cast<uint32_t>(std::clamp(std::ceil(z - 0.5), 0.0, static_cast<double>(size))); };
    int winding = 0;
    Interior::Run run;
    for (const Crossing& crossing : crossings)
    {
        const bool was_inside = winding != 0;
        winding += crossing.turn;
        if (!was_inside)
        {
            const uint32_t begin = firstMiddleFrom(crossing.z);
            if (run.end > run.begin && begin > run.end)
            {
                runs.add(run);
                run = {};
            }
            if (run.end <= run.begin)
                run.begin = begin; // else it goes on where the last one ended
        }
        else if (winding == 0)
            run.end = firstMiddleFrom(crossing.z);
    }
    if (run.end > run.begin)
        runs.add(run);
}

} // namespace

Interior::Interior(const ClosedSurface& surface, const GridFrame& frame)
{
    begin_ = {std::numeric_limits<uint32_t>::max(), std::numeric_limits<uint32_t>::max()};
    std::vector<FlatTriangle> triangles;
    for (size_t i = 0; i + 2 < surface.indices.size(); i += 3)
    {
        const Double3& a = surface.positions[surface.indices[i]];
        const Double3& b = surface.positions[surface.indices[i + 1]];
        const Double3& c = surface.positions[surface.indices[i + 2]];
        if (!isFinite(a) || !isFinite(b) || !isFinite(c))
            continue;
        const FlatTriangle triangle(a, b, c);
        const std::array<uint32_t, 2> xs = triangle.columnsX(frame.voxels[0]);
        const std::array<uint32_t, 2> ys = triangle.columnsY(frame.voxels[1]);
        if (xs[0] >= xs[1] || ys[0] >= ys[1])
            continue;
        begin_ = {std::min(begin_[0], xs[0]), std::min(begin_[1], ys[0])};
        end_ = {std::max(end_[0], xs[1]), std::max(end_[1], ys[1])};
        triangles.push_back(triangle);
    }
    if (triangles.empty())
    {
        begin_ = end_ = {};
        return;
    }
    const size_t width = end_[0] - begin_[0];
    std::vector<Crossing> crossings;
    for (const FlatTriangle& triangle : triangles)
    {
        const std::array<uint32_t, 2> xs = triangle.columnsX(frame.voxels[0]);
        const std::array<uint32_t, 2> ys = triangle.columnsY(frame.voxels[1]);
        for (uint32_t y = ys[0]; y < ys[1]; ++y)
            for (uint32_t x = xs[0]; x < xs[1]; ++x)
                if (const int turn = triangle.findTurn(x + 0.5, y + 0.5); turn != 0)
                    crossings.push_back({(x - begin_[0]) + width * (y - begin_[1]),
                                         triangle.heightAt(x + 0.5, y + 0.5), turn});
    }
    std::ranges::sort(crossings, [](const Crossing& a, const Crossing& b)
                      { return a.column != b.column ? a.column < b.column : a.z < b.z; });
    size_t next = 0;
    for (size_t column = 0; column < width * (end_[1] - begin_[1]); ++column)
    {
        const size_t first = next;
        while (next < crossings.size() && crossings[next].column == column)
            ++next;
        appendRuns(std::span(crossings).subspan(first, next - first), frame.voxels[2], runs_);
        runs_.endList();
    }
}

std::span<const Interior::Run> Interior::runs(uint32_t x, uint32_t y) const
{
    if (x < begin_[0] || x >= end_[0] || y < begin_[1] || y >= end_[1])
        return {};
    return runs_[(x - begin_[0]) + size_t{end_[0] - begin_[0]} * (y - begin_[1])];
}

bool Interior::has(const Cell& cell) const
{
    return std::ranges::any_of(runs(cell[0], cell[1]),
                               [&](const Run& run) { return run.begin <= cell[2] && cell[2] < run.end; });
}

} // namespace hearth::bricks
