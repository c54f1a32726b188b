// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/transform_model.h"

#include "cook/animation_bounds/slerp_model.h"
#include "cook/animation_bounds/symmetric.h"

#include <algorithm>
#include <cmath>

namespace hearth::animation_bounds
{

namespace
{

// Rounding error of a product, as a share of its factors.
constexpr double kTransformRounding = 1e-14;

// Distance from 1 below which a scale counts as a rounded 1.
constexpr double kNearRigid = 1e-5;

/// Limit the remainder by `norm`, the maximum operator norm: where it is larger, the polynomial carries no
/// information.
void limitRemainder(TransformModel& transform)
{
    if (transform.linear.remainder < transform.norm)
        return;
    transform.linear.terms = {};
    transform.linear.remainder = transform.norm;
    transform.norms = {};
}

RigidModel makeRigid(const TaylorModel<4>& rotation, double stretch)
{
    return {rotation, degreeNorms(rotation), stretch};
}

/// Quaternion q as the matrix of the product p q, by columns: those of p's w, x, y and z.
using FactorColumns = std::array<std::array<double, 4>, 4>;

FactorColumns factorColumns(const std::array<double, 4>& q)
{
    return {{{q[0], q[1], q[2], q[3]},
             {q[3], -q[2], q[1], -q[0]},
             {q[2], q[3], -q[0], -q[1]},
             {-q[1], q[0], q[3], -q[2]}}};
}

/// Return the product: b, then a.
RigidModel composeRigid(const RigidModel& a, const RigidModel& b)
{
    std::array<FactorColumns, kTerms> columns;
    for (size_t term = 0; term < kTerms; ++term)
        columns[term] = factorColumns(b.rotation.terms[term]);
    TaylorModel<4> rotation;
    for (const TermProduct& product : kProducts)
    {
        const auto& p = a.rotation.terms[product.one];
        const FactorColumns& q = columns[product.other];
        std::array<double, 4>& sum = rotation.terms[product.product];
        for (size_t i = 0; i < 4; ++i)
            sum[i] += p[3] * q[0][i] + p[0] * q[1][i] + p[1] * q[2][i] + p[2] * q[3][i];
    }
    // for quaternions of length 1: (a + e) (b + f) = a b + a f + e (b + f)
    rotation.remainder = a.norms.all() * b.rotation.remainder + a.rotation.remainder +
                         omittedTerms(a.norms, b.norms) + kTransformRounding;
    // for rotations with a stretch: (A + E) (B + F) = A B + E B + (A + E) F
    return makeRigid(rotation.remainder < 1 ? rotation : anyRotation(),
                     a.stretch + (1 + a.stretch) * b.stretch);
}

/// Set the linear part from its rotation: |q|^2 times the matrix of q, which is of second degree in q.
void setLinear(TransformModel& transform)
{
    const TaylorModel<4>& rotation = transform.rigid->rotation;
    MatrixModel& matrix = transform.linear;
    matrix.terms = {};
    for (const TermSquare& square : kSquares)
    {
        const auto [ax, ay, az, aw] = rotation.terms[square.one];
        const auto& q = rotation.terms[square.other];
        const double bx = square.times * q[0], by = square.times * q[1], bz = square.times * q[2],
                     bw = square.times * q[3];
        const double xx = ax * bx, yy = ay * by, zz = az * bz, ww = aw * bw;
        const double xy = ax * by + ay * bx, xz = ax * bz + az * bx, yz = ay * bz + az * by;
        const double xw = ax * bw + aw * bx, yw = ay * bw + aw * by, zw = az * bw + aw * bz;
        std::array<double, 9>& m = matrix.terms[square.product];
        m[0] += ww + xx - yy - zz;
        m[1] += xy - zw;
        m[2] += xz + yw;
        m[3] += xy + zw;
        m[4] += ww - xx + yy - zz;
        m[5] += yz - xw;
        m[6] += xz - yw;
        m[7] += yz + xw;
        m[8] += ww - xx - yy + zz;
    }
    // q x q* with q = p + e: e x q* + p x e*
    const DegreeNorms& p = transform.rigid->norms;
    transform.norms = {p.constant * p.constant, 2 * p.constant * p.linear,
                       2 * p.constant * p.quadratic + p.linear * p.linear};
    matrix.remainder = rotation.remainder * (2 + rotation.remainder) + omittedTerms(p, p) +
                       kTransformRounding + transform.rigid->stretch;
    limitRemainder(transform);
}

std::array<double, kTerms> axisTerms(const VectorModel& model, size_t axis)
{
    std::array<double, kTerms> terms;
    for (size_t term = 0; term < kTerms; ++term)
        terms[term] = model.terms[term][axis];
    return terms;
}

Interval axisRange(const VectorModel& model, size_t axis)
{
    Interval range = polynomialRange(axisTerms(model, axis));
    range.grow(model.remainder);
    return range;
}

using AxisRanges = std::array<Interval, 3>;

AxisRanges axisRanges(const VectorModel& model)
{
    return {axisRange(model, 0), axisRange(model, 1), axisRange(model, 2)};
}

double largest(const AxisRanges& ranges)
{
    return std::max({ranges[0].magnitude(), ranges[1].magnitude(), ranges[2].magnitude()});
}

/// Return 1 / s axis by axis; nothing where s can be 0.
std::optional<VectorModel> reciprocal(const VectorModel& s)
{
    VectorModel result;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        const Interval range = axisRange(s, axis);
        const double least = range.low > 0 ? range.low : -range.high;
        if (!(least > 1e-6 * range.magnitude()))
            return std::nullopt;
        const std::array<double, kTerms> terms = axisTerms(s, axis);
        const double inverse = 1 / terms[0], square = inverse * inverse, cube = square * inverse;
        result.terms[0][axis] = inverse;
        double linear = 0, away = s.remainder;
        for (size_t term = 1; term < kTerms; ++term)
        {
            result.terms[term][axis] = -terms[term] * square;
            away += std::abs(terms[term]);
        }
        for (size_t a = 0; a < 3; ++a)
        {
            linear += std::abs(terms[kFirstLinear + a]);
            for (size_t b = 0; b < 3; ++b)
                result.terms[termIndex(a, b)][axis] +=
                    terms[kFirstLinear + a] * terms[kFirstLinear + b] * cube;
        }
        // 1 / (c + d) = 1/c - d/c^2 + d^2/c^3 - d^3/e^4, e between c and c + d
        const double remainder = s.remainder * square + (away * away - linear * linear) * std::abs(cube) +
                                 away * away * away / (least * least * least * least);
        result.remainder = std::max(result.remainder, remainder + kTransformRounding * std::abs(inverse));
    }
    return result;
}

/// Return the maximum distance of a scale from 1.
double maxDistanceFromOne(const AxisRanges& scale)
{
    double away = 0;
    for (const Interval& range : scale)
        away = std::max({away, range.high - 1, 1 - range.low});
    return away;
}

TaylorModel<4> conjugate(TaylorModel<4> rotation)
{
    for (std::array<double, 4>& term : rotation.terms)
        for (size_t i = 0; i < 3; ++i)
            term[i] = -term[i];
    return rotation;
}

TransformModel rotationModel(const TaylorModel<4>& rotation)
{
    TransformModel model;
    model.rigid = makeRigid(rotation, 0);
    return model;
}

/// Multiply a rotation by a diagonal matrix. `axis_of` returns the diagonal index for an element of the
/// product.
template <typename AxisOf>
void scaleElements(TransformModel& model, const VectorModel& scale, const AxisOf& axis_of)
{
    const AxisRanges ranges = axisRanges(scale);
    model.norm = largest(ranges);
    if (const double away = maxDistanceFromOne(ranges); away < kNearRigid)
    {
        model.rigid->stretch = away;
        return;
    }
    setLinear(model);
    model.rigid.reset();
    const DegreeNorms of_scale = degreeNorms(scale);
    MatrixModel scaled;
    for (const TermProduct& product : kProducts)
        for (size_t i = 0; i < 9; ++i)
            scaled.terms[product.product][i] +=
                model.linear.terms[product.one][i] * scale.terms[product.other][axis_of(i)];
    scaled.remainder = model.linear.remainder * model.norm + scale.remainder * (1 + model.linear.remainder) +
                       omittedTerms(model.norms, of_scale) + kTransformRounding * model.norm;
    model.linear = scaled;
    model.norms = degreeNorms(scaled);
    limitRemainder(model);
}

void scaleBefore(TransformModel& model, const VectorModel& scale)
{
    scaleElements(model, scale, [](size_t element) { return element % 3; });
}

void scaleAfter(TransformModel& model, const VectorModel& scale)
{
    scaleElements(model, scale, [](size_t element) { return element / 3; });
}

VectorModel constantProduct(const MatrixModel& matrix, const std::array<double, 3>& vector)
{
    VectorModel result;
    for (size_t term = 0; term < kTerms; ++term)
        for (size_t row = 0; row < 3; ++row)
            for (size_t k = 0; k < 3; ++k)
                result.terms[term][row] += matrix.terms[term][row * 3 + k] * vector[k];
    return result;
}

/// Apply the linear part to a vector.
VectorModel applyLinear(const TransformModel& transform, const VectorModel& vector)
{
    const DegreeNorms norms = degreeNorms(vector);
    // special case for speed: most joints rotate, with a constant translation
    VectorModel result = norms.linear == 0 && norms.quadratic == 0
                             ? constantProduct(transform.linear, vector.terms[0])
                             : productTerms(transform.linear, vector);
    result.remainder = transform.norm * vector.remainder +
                       (transform.linear.remainder + kTransformRounding * transform.norm) * norms.all() +
                       omittedTerms(transform.norms, norms);
    return result;
}

} // namespace

TransformModel identityModel()
{
    TaylorModel<4> rotation;
    rotation.terms[0][3] = 1;
    TransformModel model = rotationModel(rotation);
    setLinear(model);
    return model;
}

TransformModel constantModel(const Affine3d& transform)
{
    TransformModel model;
    model.norm = operatorNorm(transform);
    for (size_t row = 0; row < 3; ++row)
    {
        for (size_t column = 0; column < 3; ++column)
            model.linear.terms[0][row * 3 + column] = transform.m[row][column];
        model.place.terms[0][row] = transform.m[row][3];
    }
    model.norms.constant = model.norm;
    return model;
}

TransformModel parentFromNode(const NodeModel& node)
{
    TransformModel model = rotationModel(node.rotation);
    model.place = node.translation;
    scaleBefore(model, node.scale);
    return model;
}

std::optional<TransformModel> nodeFromParent(const NodeModel& node)
{
    const std::optional<VectorModel> inverse = reciprocal(node.scale);
    if (!inverse)
        return std::nullopt;
    TransformModel model = rotationModel(conjugate(node.rotation));
    scaleAfter(model, *inverse);
    const auto& translation = node.translation.terms;
    model.pivot = {translation[0][0], translation[0][1], translation[0][2]};
    VectorModel away; // from the node's origin to the pivot
    for (size_t term = 1; term < kTerms; ++term)
        for (size_t i = 0; i < 3; ++i)
            away.terms[term][i] = -translation[term][i];
    away.remainder = node.translation.remainder;
    if (model.rigid)
        setLinear(model);
    model.place = applyLinear(model, away);
    model.place.remainder += kTransformRounding * model.norm * length(model.pivot);
    return model;
}

void compose(const TransformModel& second, TransformModel& first, TransformModel& result)
{
    result.rigid.reset();
    result.pivot = first.pivot;
    result.norm = second.norm * first.norm;
    if (second.rigid && first.rigid)
    {
        result.rigid = composeRigid(*second.rigid, *first.rigid);
        setLinear(result);
    }
    else
    {
        if (first.rigid)
            setLinear(first);
        result.linear = productTerms(second.linear, first.linear);
        // (A + E) (B + F) = A B + E B + (A + E) F
        result.linear.remainder = second.linear.remainder * (first.norm + first.linear.remainder) +
                                  second.norm * first.linear.remainder +
                                  omittedTerms(second.norms, first.norms) + kTransformRounding * result.norm;
        result.norms = degreeNorms(result.linear);
        limitRemainder(result);
    }
    VectorModel away = first.place; // relative to the second pivot
    away.terms[0][0] -= second.pivot.x;
    away.terms[0][1] -= second.pivot.y;
    away.terms[0][2] -= second.pivot.z;
    result.place = applyLinear(second, away);
    for (size_t term = 0; term < kTerms; ++term)
        for (size_t i = 0; i < 3; ++i)
            result.place.terms[term][i] += second.place.terms[term][i];
    result.place.remainder +=
        second.place.remainder + kTransformRounding * second.norm * length(second.pivot);
}

} // namespace hearth::animation_bounds
