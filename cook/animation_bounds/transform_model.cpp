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

HEARTH_INLINE inline void loadTerms(const TaylorModel<4>& model, Four (&terms)[kTerms])
{
    for (size_t term = 0; term < kTerms; ++term)
        load(model.terms[term], terms[term]);
}

HEARTH_INLINE inline void storeTerms(const Four (&terms)[kTerms], TaylorModel<4>& model)
{
    for (size_t term = 0; term < kTerms; ++term)
        store(terms[term], model.terms[term]);
}

/// Set the rotation: b, then a.
HEARTH_INLINE inline void composeRigid(const RigidModel& a, const RigidModel& b, RigidModel& result)
{
    // b's quaternions q as the matrices of the products p q, by columns: those of p's w, x, y and z
    Four w[kTerms], x[kTerms], y[kTerms], z[kTerms];
    loadTerms(b.rotation, w);
    for (size_t term = 0; term < kTerms; ++term)
    {
        const Four& q = w[term];
        x[term] = __builtin_shufflevector(q, q, 3, 2, 1, 0) * Four{1, -1, 1, -1};
        y[term] = __builtin_shufflevector(q, q, 2, 3, 0, 1) * Four{1, 1, -1, -1};
        z[term] = __builtin_shufflevector(q, q, 1, 0, 3, 2) * Four{-1, 1, 1, -1};
    }
    const auto multiply = [&](size_t one, size_t other, Four& sum) HEARTH_INLINE
    {
        const std::array<double, 4>& p = a.rotation.terms[one];
        sum += w[other] * p[3] + x[other] * p[0] + y[other] * p[1] + z[other] * p[2];
    };
    Four product[kTerms] = {};
    addProducts(multiply, product);
    // for quaternions of length 1: (a + e) (b + f) = a b + a f + e (b + f)
    result.rotation.remainder = a.norms.all() * b.rotation.remainder + a.rotation.remainder +
                                omittedTerms(a.norms, b.norms) + kTransformRounding;
    // for rotations with a stretch: (A + E) (B + F) = A B + E B + (A + E) F
    result.stretch = a.stretch + (1 + a.stretch) * b.stretch;
    if (result.rotation.remainder < 1)
    {
        storeTerms(product, result.rotation);
        result.norms = degreeNorms(product);
    }
    else
    {
        result.rotation = anyRotation();
        result.norms = {};
    }
}

/// Quaternion for products of pairs of its numbers.
struct PairedQuaternion
{
    Four all;    ///< x y z w
    Four xxy;    ///< x x y
    Four yzz;    ///< y z z
    Four zyx;    ///< z y x
    Four repeat; ///< w w w
};

HEARTH_INLINE inline void makePaired(const Four& q, PairedQuaternion& paired)
{
    paired = {q, __builtin_shufflevector(q, q, 0, 0, 1, 3), __builtin_shufflevector(q, q, 1, 2, 2, 3),
              __builtin_shufflevector(q, q, 2, 1, 0, 3), __builtin_shufflevector(q, q, 3, 3, 3, 3)};
}

/// Sums of products of two quaternions' numbers: what a rotation matrix consists of.
struct PairSums
{
    Four squares{}; ///< xx yy zz ww
    Four mixed{};   ///< xy xz yz
    Four turn{};    ///< zw yw xw
};

HEARTH_INLINE inline void addPairs(const PairedQuaternion& a, const PairedQuaternion& b, PairSums& sums)
{
    sums.squares += a.all * b.all;
    sums.mixed += a.xxy * b.yzz + a.yzz * b.xxy;
    sums.turn += a.zyx * b.repeat + a.repeat * b.zyx;
}

/// Elements of a 3 x 3 matrix: three each, m[row][column].
struct MatrixParts
{
    Four diagonal; ///< 00 11 22
    Four plus;     ///< 10 02 21
    Four minus;    ///< 01 20 12
};

HEARTH_INLINE inline void storeMatrix(const MatrixParts& parts, std::array<double, 9>& matrix)
{
    const Four corner = __builtin_shufflevector(parts.diagonal, parts.minus, 0, 4, 1, 5); // 00 01 11 20
    const Four sides = __builtin_shufflevector(parts.minus, parts.plus, 2, 6, 1, 5);      // 12 21 20 02
    const Four first = __builtin_shufflevector(corner, parts.plus, 0, 1, 5, 4);           // 00 01 02 10
    const Four second = __builtin_shufflevector(corner, sides, 2, 4, 6, 5);               // 11 12 20 21
    std::memcpy(&matrix[0], &first, sizeof first);
    std::memcpy(&matrix[4], &second, sizeof second);
    matrix[8] = parts.diagonal[2];
}

/// Set the linear part from its rotation: |q|^2 times the matrix of q, which is of second degree in q.
HEARTH_INLINE inline void setLinear(TransformModel& transform)
{
    const TaylorModel<4>& rotation = transform.rigid->rotation;
    MatrixModel& matrix = transform.linear;
    // pairs of different terms occur twice
    PairedQuaternion terms[kTerms], doubled[3];
    for (size_t term = 0; term < kTerms; ++term)
    {
        Four q;
        load(rotation.terms[term], q);
        makePaired(q, terms[term]);
        if (term < 3)
            makePaired(2.0 * q, doubled[term]);
    }
    for (size_t term = 0; term < kTerms; ++term)
    {
        PairSums sums;
        addPairs(term == 0 ? terms[0] : doubled[0], terms[term], sums);
        if (term >= kFirstQuadratic)
        {
            const auto [a, b] = kQuadraticParameters[term - kFirstQuadratic];
            addPairs(a == b ? terms[kFirstLinear + a] : doubled[kFirstLinear + a], terms[kFirstLinear + b],
                     sums);
        }
        const Four& squares = sums.squares;
        storeMatrix({__builtin_shufflevector(squares, squares, 3, 3, 3, 3) + squares -
                         __builtin_shufflevector(squares, squares, 1, 2, 0, 3) -
                         __builtin_shufflevector(squares, squares, 2, 0, 1, 3),
                     sums.mixed + sums.turn, sums.mixed - sums.turn},
                    matrix.terms[term]);
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

/// Set the linear part only.
HEARTH_INLINE inline void setRotation(const TaylorModel<4>& rotation, TransformModel& model)
{
    Four terms[kTerms];
    loadTerms(rotation, terms);
    model.rigid = {rotation, degreeNorms(terms), 0};
    model.norm = 1;
}

/// Multiply a rotation by a diagonal matrix. `axis_of` returns the diagonal index for an element of the
/// product.
template <typename AxisOf>
HEARTH_INLINE inline void scaleElements(TransformModel& model, const VectorModel& scale,
                                        const AxisOf& axis_of)
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

HEARTH_INLINE inline void scaleBefore(TransformModel& model, const VectorModel& scale)
{
    scaleElements(model, scale, [](size_t element) { return element % 3; });
}

HEARTH_INLINE inline void scaleAfter(TransformModel& model, const VectorModel& scale)
{
    scaleElements(model, scale, [](size_t element) { return element / 3; });
}

bool isConstant(const VectorModel& vector)
{
    bool is_constant = true;
    for (size_t term = 1; term < kTerms; ++term)
        for (size_t i = 0; i < 3; ++i)
            is_constant &= vector.terms[term][i] == 0;
    return is_constant;
}

/// Apply the linear part to a vector.
HEARTH_INLINE inline void applyLinear(const TransformModel& transform, const VectorModel& vector,
                                      VectorModel& result)
{
    DegreeNorms norms;
    // special case for speed: most joints rotate, with a constant translation
    if (isConstant(vector))
    {
        const auto& [x, y, z] = vector.terms[0];
        norms.constant = length(Double3{x, y, z});
        for (size_t term = 0; term < kTerms; ++term)
        {
            const std::array<double, 9>& m = transform.linear.terms[term];
            for (size_t row = 0; row < 3; ++row)
                result.terms[term][row] = m[row * 3] * x + m[row * 3 + 1] * y + m[row * 3 + 2] * z;
        }
    }
    else
    {
        norms = degreeNorms(vector);
        result = productTerms(transform.linear, vector);
    }
    result.remainder = transform.norm * vector.remainder +
                       (transform.linear.remainder + kTransformRounding * transform.norm) * norms.all() +
                       omittedTerms(transform.norms, norms);
}

/// Set the transform from the parent to the node; false if a scale can be 0.
HEARTH_INLINE inline bool setInverse(const NodeModel& node, TransformModel& model)
{
    const std::optional<VectorModel> inverse = reciprocal(node.scale);
    if (!inverse)
        return false;
    setRotation(conjugate(node.rotation), model);
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
    applyLinear(model, away, model.place);
    model.place.remainder += kTransformRounding * model.norm * length(model.pivot);
    return true;
}

HEARTH_INLINE inline void setComposition(const TransformModel& second, TransformModel& first,
                                         TransformModel& result)
{
    result.rigid.reset();
    result.pivot = first.pivot;
    result.norm = second.norm * first.norm;
    if (second.rigid && first.rigid)
    {
        composeRigid(*second.rigid, *first.rigid, result.rigid.emplace());
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
    applyLinear(second, away, result.place);
    for (size_t term = 0; term < kTerms; ++term)
        for (size_t i = 0; i < 3; ++i)
            result.place.terms[term][i] += second.place.terms[term][i];
    result.place.remainder +=
        second.place.remainder + kTransformRounding * second.norm * length(second.pivot);
}

} // namespace

TransformModel identityModel()
{
    TaylorModel<4> rotation;
    rotation.terms[0][3] = 1;
    TransformModel model;
    setRotation(rotation, model);
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

void setParentFromNode(const NodeModel& node, TransformModel& transform)
{
    transform.pivot = {};
    transform.place = node.translation;
    callWithWideVectors(
        [&]() HEARTH_INLINE
        {
            setRotation(node.rotation, transform);
            scaleBefore(transform, node.scale);
        });
}

bool setNodeFromParent(const NodeModel& node, TransformModel& transform)
{
    bool has_inverse = false;
    callWithWideVectors([&]() HEARTH_INLINE { has_inverse = setInverse(node, transform); });
    return has_inverse;
}

void compose(const TransformModel& second, TransformModel& first, TransformModel& result)
{
    callWithWideVectors([&]() HEARTH_INLINE { setComposition(second, first, result); });
}

} // namespace hearth::animation_bounds
