// Decides which cells of a light grid a light reaches. A ball is exact: the part of it between the planes
// of a slab and of a row is convex, so it covers one interval of columns, whose ends are tangents or lie on
// those planes. A cone has to meet two such balls, its least one and that of its range, and is tested
// against seven planes. One source for the shaders and their CPU twin; on IEEE hardware all bits agree. The
// code uses only + - * / and sqrt, in a fixed order, without contraction.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LIGHT_CELLS_H
#define HEARTH_SHARED_LIGHT_CELLS_H

#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/light_grid.h"
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/reflector.h"

HEARTH_SHARED_BEGIN

/// Light with a range in view space, as the tests of cells need it.
struct CellLight
{
    Float3 center; ///< of the least ball around what it lights
    float radius;  ///< of that ball, grown by the slack
    Float3 apex;   ///< of a cone, as the next fields
    float range;
    Float3 axis;  ///< unit
    float cosine; ///< of the half-angle; negative: the light has no cone
    float sine;
    float slack;     ///< metres by which all that it lights has grown
    uint first_slab; ///< that it reaches, counted over all cascades
    uint last_slab;
};

/// Metres by which balls and cones grow. It covers three things: a shaded point lies up to 1/64 of a pixel
/// off the ray of its pixel, its depth may round into the next slab, and the tests round.
/// extent  distance of the farthest lit point from the eye
HEARTH_FUNCTION float lightSlack(HEARTH_IN(LightGrid) grid, float extent)
{
    HEARTH_PRECISE float slack = extent * grid.slack_share + grid.slack_size;
    return slack;
}

/// True if every point gets the light, whatever its distance.
HEARTH_FUNCTION bool isUnrangedLight(HEARTH_IN(Light) light)
{
    return light.type == kLightDirectional || light.range <= 0.0f;
}

HEARTH_FUNCTION bool isLightOff(HEARTH_IN(Light) light)
{
    return light.intensity.x == 0.0f && light.intensity.y == 0.0f && light.intensity.z == 0.0f;
}

/// Bring a light with a range to view space; its slabs are left to the caller, who has the cascades. The
/// least ball of a cone with half-angle t and range r has its centre on the axis: at r / (2 cos t) with
/// that radius up to 45 degrees, else at r cos t with r sin t. A spot with a reflector lights its whole
/// ball, and so does a cone above 90 degrees.
HEARTH_FUNCTION CellLight makeCellLight(HEARTH_IN(LightGrid) grid, HEARTH_IN(Light) light)
{
    HEARTH_PRECISE Float3 offset = light.position - grid.eye;
    CellLight cell;
    cell.apex = Float3(dot3(grid.right, offset), dot3(grid.down, offset), dot3(grid.forward, offset));
    cell.axis = Float3(dot3(grid.right, light.direction), dot3(grid.down, light.direction),
                       dot3(grid.forward, light.direction));
    cell.range = light.range;
    cell.center = cell.apex;
    cell.first_slab = 0u;
    cell.last_slab = 0u;
    cell.cosine = -1.0f;
    cell.sine = 0.0f;
    HEARTH_PRECISE float radius = light.range;
    if (light.type == kLightSpot && light.reflector_gain == kNoReflector)
    {
        // the cosine at which the falloff of the cone is 0
        HEARTH_PRECISE float cosine = -light.cone_offset / light.cone_scale - kRoundingSlack;
        if (cosine >= 0.0f)
        {
            HEARTH_PRECISE float sine = sqrt(max(1.0f - cosine * cosine, 0.0f));
            HEARTH_PRECISE float along = cosine * light.range;
            radius = sine * light.range;
            if (cosine >= sine)
            {
                radius = light.range / (2.0f * cosine);
                along = radius;
            }
            HEARTH_PRECISE Float3 center = cell.apex + cell.axis * along;
            cell.center = center;
            cell.cosine = cosine;
            cell.sine = sine;
        }
    }
    HEARTH_PRECISE float extent = sqrt(dot3(cell.center, cell.center)) + radius;
    cell.slack = lightSlack(grid, extent);
    HEARTH_PRECISE float grown = radius + cell.slack;
    cell.radius = grown;
    return cell;
}

/// Return x / u and y / v at a depth.
HEARTH_FUNCTION float lightPlaneScale(HEARTH_IN(LightGrid) grid, float depth)
{
    return grid.is_orthographic != 0u ? 1.0f : depth;
}

/// True if a ball is partly on the inner side of a plane through the eye, or along the view of an
/// orthographic one: coordinate - edge * scale >= 0.
/// side  1: greater coordinates are inside; -1: smaller ones
HEARTH_FUNCTION bool isBallInside(float coordinate, float scale, float edge, float edge_length, float side,
                                  float radius)
{
    HEARTH_PRECISE float distance = side * (coordinate - edge * scale) + radius * edge_length;
    return distance >= 0.0f;
}

/// True unless the ball of a light is outside of one plane of the view.
HEARTH_FUNCTION bool isLightInView(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light)
{
    float scale = lightPlaneScale(grid, light.center.z);
    HEARTH_PRECISE float farthest = light.center.z + light.radius;
    return farthest >= grid.z_near &&
           isBallInside(light.center.x, scale, grid.edges.x, grid.edge_lengths.x, 1.0f, light.radius) &&
           isBallInside(light.center.x, scale, grid.edges.y, grid.edge_lengths.y, -1.0f, light.radius) &&
           isBallInside(light.center.y, scale, grid.edges.z, grid.edge_lengths.z, 1.0f, light.radius) &&
           isBallInside(light.center.y, scale, grid.edges.w, grid.edge_lengths.w, -1.0f, light.radius);
}

/// Depths between which a cell lies.
struct LightSlab
{
    float begin;
    float end;
};

/// Return a slab of a cascade. The first one of all begins just before the near plane, the last one ends
/// nowhere.
HEARTH_FUNCTION LightSlab lightSlab(HEARTH_IN(LightGrid) grid, HEARTH_IN(LightCascade) cascade, uint number)
{
    LightSlab slab;
    HEARTH_PRECISE float begin = cascade.begin + float(number) * cascade.slab_depth;
    HEARTH_PRECISE float end = cascade.begin + float(number + 1u) * cascade.slab_depth;
    HEARTH_PRECISE float nearest = grid.z_near * 0.9990234375f;
    slab.begin = cascade.first_slab + number == 0u ? nearest : max(begin, nearest);
    slab.end = cascade.first_slab + number + 1u == grid.slab_count ? kMaxFiniteError : end;
    return slab;
}

/// Edges in v between which a row lies.
struct LightRow
{
    float begin;
    float end;
};

HEARTH_FUNCTION float lightRowEdge(HEARTH_IN(LightGrid) grid, HEARTH_IN(LightCascade) cascade, uint edge)
{
    HEARTH_PRECISE float v = grid.edges.z + float(edge) * cascade.row_step;
    return v;
}

HEARTH_FUNCTION float lightColumnEdge(HEARTH_IN(LightGrid) grid, HEARTH_IN(LightCascade) cascade, uint edge)
{
    HEARTH_PRECISE float u = grid.edges.x + float(edge) * cascade.column_step;
    return u;
}

/// Return the depths of a tile: those of its pixels, with room for the roundings by which the pass that finds
/// them may differ from the one that shades.
/// least, greatest  of its pixels; least above greatest: it shows no surface
HEARTH_FUNCTION LightSlab tileSlab(HEARTH_IN(LightGrid) grid, float least, float greatest)
{
    LightSlab slab;
    HEARTH_PRECISE float begin = least * 0.9990234375f;
    HEARTH_PRECISE float end = greatest * 1.0009765625f;
    HEARTH_PRECISE float nearest = grid.z_near * 0.9990234375f;
    slab.begin = max(begin, nearest);
    slab.end = end;
    return slab;
}

// ---- balls

/// Both planes of equal u that touch a disc of a ball, and the depths at which they do.
struct LightTangents
{
    float u0;
    float depth0; ///< negative: there is none
    float u1;
    float depth1;
};

/// Solve for the planes x = u z that touch a disc in a plane through the eye. In that plane, with the points
/// (x, z), the disc is (x - cx)^2 + g (z - h / g)^2 <= d / g, and u solves e u^2 - 2 cx h u + g cx^2 - d = 0.
/// power  squared distance from the eye to the ball's centre, less its squared radius
HEARTH_FUNCTION LightTangents lightTangents(float cx, float h, float g, float d, float e, float power)
{
    LightTangents tangents;
    tangents.u0 = 0.0f;
    tangents.u1 = 0.0f;
    tangents.depth0 = -1.0f;
    tangents.depth1 = -1.0f;
    if (power <= 0.0f || d < 0.0f) // the eye is in the ball, or the plane misses it
        return tangents;
    HEARTH_PRECISE float product = cx * h;
    HEARTH_PRECISE float root = sqrt(power * d);
    HEARTH_PRECISE float sum = product >= 0.0f ? product + root : product - root;
    if (sum == 0.0f) // a point of the disc on the axis
    {
        HEARTH_PRECISE float depth = h / g;
        tangents.depth0 = depth;
        return tangents;
    }
    // the ball all but touches a line x = const through the eye: one of the tangents is beyond all images
    HEARTH_PRECISE float least = (h * h) * 1e-12f + 1e-30f;
    HEARTH_PRECISE float divisor = abs(e) < least ? least : e;
    // the second root by the product of both, without cancellation
    HEARTH_PRECISE float u0 = sum / divisor;
    HEARTH_PRECISE float u1 = (g * cx * cx - d) / sum;
    HEARTH_PRECISE float depth0 = (u0 * cx + h) / (u0 * u0 + g);
    HEARTH_PRECISE float depth1 = (u1 * cx + h) / (u1 * u1 + g);
    tangents.u0 = u0;
    tangents.u1 = u1;
    tangents.depth0 = depth0;
    tangents.depth1 = depth1;
    return tangents;
}

/// Squares that all tests of a ball need.
struct LightBall
{
    float radius2;
    float power; ///< see lightTangents
};

HEARTH_FUNCTION LightBall lightBall(HEARTH_IN(CellLight) light)
{
    HEARTH_PRECISE float radius2 = light.radius * light.radius;
    HEARTH_PRECISE float power = dot3(light.center, light.center) - radius2;
    LightBall ball;
    ball.radius2 = radius2;
    ball.power = power;
    return ball;
}

/// Return the tangents in the plane of a row's edge.
HEARTH_FUNCTION LightTangents lightEdgeTangents(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light,
                                                HEARTH_IN(LightBall) ball, float v)
{
    Float3 c = light.center;
    if (grid.is_orthographic != 0u)
    {
        HEARTH_PRECISE float off = v - c.y;
        HEARTH_PRECISE float half2 = ball.radius2 - off * off;
        HEARTH_PRECISE float half_width = sqrt(max(half2, 0.0f));
        LightTangents tangents;
        tangents.u0 = c.x - half_width;
        tangents.u1 = c.x + half_width;
        tangents.depth0 = half2 < 0.0f ? -1.0f : c.z;
        tangents.depth1 = tangents.depth0;
        return tangents;
    }
    HEARTH_PRECISE float h = v * c.y + c.z;
    HEARTH_PRECISE float g = 1.0f + v * v;
    HEARTH_PRECISE float off = c.y - v * c.z;
    HEARTH_PRECISE float d = g * ball.radius2 - off * off;
    HEARTH_PRECISE float e = (c.y * c.y + c.z * c.z) - ball.radius2;
    return lightTangents(c.x, h, g, d, e, ball.power);
}

/// Return the tangents of the whole ball, which touch it at the y of its centre.
HEARTH_FUNCTION LightTangents lightBallTangents(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light,
                                                HEARTH_IN(LightBall) ball)
{
    Float3 c = light.center;
    if (grid.is_orthographic != 0u)
    {
        LightTangents tangents;
        tangents.u0 = c.x - light.radius;
        tangents.u1 = c.x + light.radius;
        tangents.depth0 = c.z;
        tangents.depth1 = c.z;
        return tangents;
    }
    HEARTH_PRECISE float e = c.z * c.z - ball.radius2;
    HEARTH_PRECISE float power = (c.x * c.x + c.z * c.z) - ball.radius2;
    return lightTangents(c.x, c.z, 1.0f, ball.radius2, e, power);
}

/// Interval of u, empty if low > high.
struct LightSpan
{
    float low;
    float high;
};

/// Return the interval that a ball covers in the plane of a depth, between the edges of a row.
HEARTH_FUNCTION LightSpan lightChord(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light,
                                     HEARTH_IN(LightBall) ball, float depth, HEARTH_IN(LightRow) row)
{
    float scale = lightPlaneScale(grid, depth);
    HEARTH_PRECISE float y = min(max(light.center.y, row.begin * scale), row.end * scale);
    HEARTH_PRECISE float dy = y - light.center.y;
    HEARTH_PRECISE float dz = depth - light.center.z;
    HEARTH_PRECISE float half2 = (ball.radius2 - dz * dz) - dy * dy;
    LightSpan span;
    span.low = kMaxFiniteError;
    span.high = -kMaxFiniteError;
    if (half2 >= 0.0f)
    {
        HEARTH_PRECISE float half_width = sqrt(half2);
        HEARTH_PRECISE float low = (light.center.x - half_width) / scale;
        HEARTH_PRECISE float high = (light.center.x + half_width) / scale;
        span.low = low;
        span.high = high;
    }
    return span;
}

HEARTH_FUNCTION LightSpan joinSpans(LightSpan a, LightSpan b)
{
    LightSpan joined;
    joined.low = min(a.low, b.low);
    joined.high = max(a.high, b.high);
    return joined;
}

/// Add the tangents that touch the ball within a slab.
HEARTH_FUNCTION LightSpan addTangents(LightSpan span, HEARTH_IN(LightTangents) tangents,
                                      HEARTH_IN(LightSlab) slab)
{
    if (tangents.depth0 >= slab.begin && tangents.depth0 <= slab.end)
    {
        span.low = min(span.low, tangents.u0);
        span.high = max(span.high, tangents.u0);
    }
    if (tangents.depth1 >= slab.begin && tangents.depth1 <= slab.end)
    {
        span.low = min(span.low, tangents.u1);
        span.high = max(span.high, tangents.u1);
    }
    return span;
}

/// Leave out the tangents of the whole ball that do not touch it in a row.
HEARTH_FUNCTION LightTangents tangentsInRow(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light,
                                            LightTangents tangents, HEARTH_IN(LightRow) row)
{
    float scale0 = lightPlaneScale(grid, tangents.depth0);
    float scale1 = lightPlaneScale(grid, tangents.depth1);
    HEARTH_PRECISE float begin0 = row.begin * scale0;
    HEARTH_PRECISE float end0 = row.end * scale0;
    HEARTH_PRECISE float begin1 = row.begin * scale1;
    HEARTH_PRECISE float end1 = row.end * scale1;
    if (light.center.y < begin0 || light.center.y > end0)
        tangents.depth0 = -1.0f;
    if (light.center.y < begin1 || light.center.y > end1)
        tangents.depth1 = -1.0f;
    return tangents;
}

/// Columns of a row, none if first > last.
struct LightColumns
{
    int first;
    int last;
};

HEARTH_FUNCTION LightColumns spanColumns(HEARTH_IN(LightGrid) grid, HEARTH_IN(LightCascade) cascade,
                                         LightSpan span)
{
    HEARTH_PRECISE float low = (span.low - grid.edges.x) * cascade.columns_per_u;
    HEARTH_PRECISE float high = (span.high - grid.edges.x) * cascade.columns_per_u;
    float columns = float(cascade.columns);
    LightColumns covered;
    covered.first = int(floor(min(max(low, 0.0f), columns)));
    covered.last = int(floor(min(max(high, -1.0f), columns - 1.0f)));
    return covered;
}

/// Return the light of a cone with the ball of its range around the apex in place of the least ball. The
/// least ball of a narrow cone reaches beyond that range, and cells have to meet both.
HEARTH_FUNCTION CellLight rangeBall(CellLight light)
{
    HEARTH_PRECISE float radius = light.range + light.slack;
    light.center = light.apex;
    light.radius = radius;
    return light;
}

HEARTH_FUNCTION LightColumns intersectColumns(LightColumns a, LightColumns b)
{
    LightColumns both;
    both.first = a.first < b.first ? b.first : a.first;
    both.last = a.last < b.last ? a.last : b.last;
    return both;
}

/// Return the columns of a row of a slab that a ball reaches.
HEARTH_FUNCTION LightColumns ballColumns(HEARTH_IN(LightGrid) grid, HEARTH_IN(LightCascade) cascade,
                                         HEARTH_IN(CellLight) light, HEARTH_IN(LightSlab) slab,
                                         HEARTH_IN(LightRow) row)
{
    LightBall ball = lightBall(light);
    LightSpan span = joinSpans(lightChord(grid, light, ball, slab.begin, row),
                               lightChord(grid, light, ball, slab.end, row));
    span = addTangents(span, lightEdgeTangents(grid, light, ball, row.begin), slab);
    span = addTangents(span, lightEdgeTangents(grid, light, ball, row.end), slab);
    span = addTangents(span, tangentsInRow(grid, light, lightBallTangents(grid, light, ball), row), slab);
    return spanColumns(grid, cascade, span);
}

/// Return the columns of a row of a slab that a light's balls reach.
HEARTH_FUNCTION LightColumns lightColumns(HEARTH_IN(LightGrid) grid, HEARTH_IN(LightCascade) cascade,
                                          HEARTH_IN(CellLight) light, HEARTH_IN(LightSlab) slab,
                                          HEARTH_IN(LightRow) row)
{
    LightColumns columns = ballColumns(grid, cascade, light, slab, row);
    if (light.cosine >= 0.0f)
        columns = intersectColumns(columns, ballColumns(grid, cascade, rangeBall(light), slab, row));
    return columns;
}

/// Bounds in u and v of what a ball covers of a slab.
struct LightBounds
{
    Float4 edges; ///< least and greatest u, least and greatest v; least above greatest: nothing
};

/// Return one side of the bounds: a coordinate over the depth at which it is farthest out.
HEARTH_FUNCTION float lightBound(HEARTH_IN(LightGrid) grid, float coordinate, float side, float begin,
                                 float end)
{
    bool is_outward = side * coordinate >= 0.0f;
    HEARTH_PRECISE float bound = coordinate / lightPlaneScale(grid, is_outward ? begin : end);
    return bound;
}

/// Bound what the tests below find of a ball in a slab, quickly: a box around the ball, grown by more than
/// their roundings.
HEARTH_FUNCTION LightBounds lightBounds(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light,
                                        HEARTH_IN(LightSlab) slab)
{
    HEARTH_PRECISE float grown = light.radius + light.slack;
    HEARTH_PRECISE float begin = max(slab.begin, light.center.z - grown);
    HEARTH_PRECISE float end = min(slab.end, light.center.z + grown);
    HEARTH_PRECISE float off = max(max(slab.begin - light.center.z, light.center.z - slab.end), 0.0f);
    HEARTH_PRECISE float half2 = grown * grown - off * off;
    LightBounds bounds;
    bounds.edges = Float4(1.0f, -1.0f, 1.0f, -1.0f);
    if (half2 >= 0.0f && begin <= end)
    {
        HEARTH_PRECISE float half_width = sqrt(half2);
        bounds.edges = Float4(lightBound(grid, light.center.x - half_width, -1.0f, begin, end),
                              lightBound(grid, light.center.x + half_width, 1.0f, begin, end),
                              lightBound(grid, light.center.y - half_width, -1.0f, begin, end),
                              lightBound(grid, light.center.y + half_width, 1.0f, begin, end));
    }
    return bounds;
}

// ---- cones

/// Return the distance from its apex that the sector of a cone reaches along a unit vector: its range times
/// cos(max(p - t, 0)) where the vector is at angle p from the axis and t is the half-angle; 0 beyond 90
/// degrees.
/// along  cosine of p
HEARTH_FUNCTION float sectorReach(HEARTH_IN(CellLight) light, float along)
{
    if (along >= light.cosine)
        return light.range;
    HEARTH_PRECISE float across = sqrt(max(1.0f - along * along, 0.0f));
    HEARTH_PRECISE float reach = light.range * max(along * light.cosine + across * light.sine, 0.0f);
    return reach;
}

/// True if a sector is wholly behind a plane through the eye, or along an orthographic view, that bounds a
/// column or a row.
/// apex, axis  coordinates across the edge
/// side        1: the cell lies at greater coordinates; -1: at smaller ones
HEARTH_FUNCTION bool isSectorBehindEdge(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light, float apex,
                                        float axis, float edge, float side)
{
    float slope = grid.is_orthographic != 0u ? 0.0f : edge;
    HEARTH_PRECISE float inverse_length = 1.0f / sqrt(1.0f + slope * slope);
    HEARTH_PRECISE float off = side * ((apex - edge * lightPlaneScale(grid, light.apex.z)) * inverse_length);
    HEARTH_PRECISE float along = side * ((axis - slope * light.axis.z) * inverse_length);
    HEARTH_PRECISE float most = (off + sectorReach(light, along)) + light.slack;
    return most < 0.0f;
}

/// True if a sector is wholly before or behind a slab.
HEARTH_FUNCTION bool isSectorOutsideSlab(HEARTH_IN(CellLight) light, HEARTH_IN(LightSlab) slab)
{
    HEARTH_PRECISE float farthest = (light.apex.z + sectorReach(light, light.axis.z)) + light.slack;
    HEARTH_PRECISE float nearest = (light.apex.z - sectorReach(light, -light.axis.z)) - light.slack;
    return farthest < slab.begin || nearest > slab.end;
}

/// Return the least distance of the corners of a cell in the plane of a depth along a vector.
HEARTH_FUNCTION float leastCorner(HEARTH_IN(LightGrid) grid, Float3 normal, float depth, Float4 edges)
{
    float scale = lightPlaneScale(grid, depth);
    HEARTH_PRECISE float x = min(normal.x * edges.x, normal.x * edges.y) * scale;
    HEARTH_PRECISE float y = min(normal.y * edges.z, normal.y * edges.w) * scale;
    HEARTH_PRECISE float least = (x + y) + normal.z * depth;
    return least;
}

/// Return the outward normal of the plane that touches a cone nearest to a point; 0 for a point on the axis.
/// Taking the part along the axis away twice leaves none: far from a narrow cone's apex its rounding alone
/// would turn the plane into the cone.
HEARTH_FUNCTION Float3 coneNormal(HEARTH_IN(CellLight) light, Float3 point)
{
    HEARTH_PRECISE Float3 offset = point - light.apex;
    float along = dot3(offset, light.axis);
    HEARTH_PRECISE Float3 first = offset - light.axis * along;
    float rest = dot3(first, light.axis);
    HEARTH_PRECISE Float3 across = first - light.axis * rest;
    float across2 = dot3(across, across);
    if (across2 == 0.0f)
        return Float3(0.0f, 0.0f, 0.0f);
    HEARTH_PRECISE float share = light.cosine / sqrt(across2);
    HEARTH_PRECISE Float3 normal = across * share - light.axis * light.sine;
    return normal;
}

/// True if the plane that touches a cone nearest to the middle of a cell has the cell on its outer side.
/// edges  of the cell: least and greatest u, least and greatest v
HEARTH_FUNCTION bool isCellBesideCone(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light,
                                      HEARTH_IN(LightSlab) slab, Float4 edges)
{
    HEARTH_PRECISE float begin = max(slab.begin, light.center.z - light.radius);
    HEARTH_PRECISE float end = min(slab.end, light.center.z + light.radius);
    HEARTH_PRECISE float depth = 0.5f * (begin + end);
    HEARTH_PRECISE float half_scale = 0.5f * lightPlaneScale(grid, depth);
    HEARTH_PRECISE Float3 middle =
        Float3((edges.x + edges.y) * half_scale, (edges.z + edges.w) * half_scale, depth);
    Float3 normal = coneNormal(light, middle);
    HEARTH_PRECISE float least =
        min(leastCorner(grid, normal, begin, edges), leastCorner(grid, normal, end, edges)) -
        dot3(normal, light.apex);
    return least > light.slack;
}

/// True unless one of seven planes parts the sector of a light from a cell: its six faces, and the plane that
/// touches the cone nearest to its middle. Lights without a cone have no such plane.
HEARTH_FUNCTION bool reachesCell(HEARTH_IN(LightGrid) grid, HEARTH_IN(CellLight) light,
                                 HEARTH_IN(LightSlab) slab, Float4 edges)
{
    if (light.cosine < 0.0f)
        return true;
    return !isSectorOutsideSlab(light, slab) &&
           !isSectorBehindEdge(grid, light, light.apex.y, light.axis.y, edges.z, 1.0f) &&
           !isSectorBehindEdge(grid, light, light.apex.y, light.axis.y, edges.w, -1.0f) &&
           !isSectorBehindEdge(grid, light, light.apex.x, light.axis.x, edges.x, 1.0f) &&
           !isSectorBehindEdge(grid, light, light.apex.x, light.axis.x, edges.y, -1.0f) &&
           !isCellBesideCone(grid, light, slab, edges);
}

HEARTH_SHARED_END

#endif
