// Tests motion vectors against points of the triangles that pixels show, posed and projected in doubles in
// both frames.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "runtime/gpu/temporal/motion_pass.h"
#include "runtime/gpu/vulkan/image_barrier.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/gpu_fixture.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr uint32_t kColumns = 128, kRows = 96;
/// Vectors of what was behind the eye, and the largest of others: what the C API says.
constexpr double kUnseen = 32768, kLongest = 16384;

struct Vector
{
    double x, y;
};

/// State of a scene, and the camera that sees it.
struct Moment
{
    std::map<uint32_t, TestPose> poses;
    std::map<uint32_t, Affine3> places; ///< of rigid instances
    Camera camera;
};

struct Axes
{
    Double3 right, up, forward;
};

Double3 unit(Double3 v)
{
    return v * (1 / length(v));
}

Axes findAxes(const Camera& camera)
{
    const Double3 forward = unit(widen(camera.target) - widen(camera.position));
    const Double3 right = unit(cross(forward, widen(camera.up)));
    return {right, cross(right, forward), forward};
}

double findFocal(const Camera& camera)
{
    return kRows / 2.0 / std::tan(camera.y_fov_rad / 2.0);
}

/// Direction in the world that the center of a pixel shows.
Double3 findDirection(const Camera& camera, uint32_t pixel)
{
    const Axes axes = findAxes(camera);
    const double right = pixel % kColumns + 0.5 - kColumns / 2.0 * (1 + double{camera.shift.x});
    const double down = pixel / kColumns + 0.5 - kRows / 2.0 * (1 - double{camera.shift.y});
    return axes.forward * findFocal(camera) + axes.right * right - axes.up * down;
}

/// Place of a direction in the image without a shift, pixels from its middle; none behind the eye.
std::optional<Vector> project(const Camera& camera, Double3 direction)
{
    const Axes axes = findAxes(camera);
    const double distance = dot(direction, axes.forward);
    if (distance <= 0)
        return std::nullopt;
    const double scale = findFocal(camera) / distance;
    return Vector{dot(direction, axes.right) * scale, -dot(direction, axes.up) * scale};
}

class MotionVectorsTest : public GpuTest
{
protected:
    MotionVectorsTest() : test_({.limbs = 3, .tentacles = 2, .blobs = 2, .rocks = 4, .rings = 16}, 7) {}

    void SetUp() override
    {
        GpuTest::SetUp();
        if (IsSkipped())
            return;
        scene_ = upload(test_.pack(), {.keeps_motion = true});
        auto pass = gpu::MotionPass::create(renderer().device(), renderer().layouts(), *scene_);
        ASSERT_TRUE(pass.ok());
        pass_.emplace(std::move(*pass));
        for (const uint32_t instance : test_.deformedInstances())
            now_.poses[instance] = test_.randomPose(instance, random_);
        for (uint32_t i = 0; i < test_.pack().instances().size(); ++i)
            if (!now_.poses.contains(i))
                now_.places[i] = test_.pack().instances()[i].world_from_object;
        now_.camera = {.position = {1, 2, 7}, .target = {0, 0.5f, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f};
    }

    gpu::FrameTargets makeMotionTargets()
    {
        auto targets = renderer().createTargets({kColumns, kRows}, {.has_motion = true});
        HEARTH_ASSERT(targets.ok());
        return std::move(*targets);
    }

    /// Draw the moment with the motion vectors.
    std::vector<Vector> drawMotion(gpu::FrameTargets& targets, const Camera& camera)
    {
        std::vector<gpu::InstanceMove> moves;
        for (const auto& [instance, place] : now_.places)
            moves.push_back(*gpu::moveInstance(*scene_, instance, place));
        std::vector<TestPose> poses;
        for (const auto& [instance, pose] : now_.poses)
            poses.push_back(pose);
        const auto views = makeViews(poses);
        const DrawOptions options{.width = kColumns, .height = kRows, .moves = moves, .poses = views};
        seen_ = draw(*scene_, targets, camera, options).seen();
        const Status status = host().run(
            [&](VkCommandBuffer commands)
            {
                pass_->record(renderer().device(), commands, *scene_, targets);
                gpu::transition(renderer().device(), commands, targets.motion().image(), gpu::kMotionLayout,
                                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0, VK_ACCESS_TRANSFER_READ_BIT,
                                gpu::kMotionReaders, VK_PIPELINE_STAGE_TRANSFER_BIT);
                return success();
            });
        HEARTH_ASSERT(status.ok());
        const auto bytes = host().read(renderer().device(), targets.motion().image(), 4);
        HEARTH_ASSERT(bytes.ok());
        std::vector<std::array<uint16_t, 2>> halves(size_t{kColumns} * kRows);
        std::memcpy(halves.data(), bytes->data(), halves.size() * sizeof(halves[0]));
        std::vector<Vector> motion;
        for (const auto& [x, y] : halves)
            motion.push_back({floatFromHalf(x), floatFromHalf(y)});
        return motion;
    }

    /// Corners of a triangle in the world.
    std::array<Double3, 3> findCorners(const Moment& moment, const std::array<uint32_t, 3>& seen) const
    {
        const auto [instance, cluster, triangle] = seen;
        const formats::ClusterGeometry geometry = test_.geometry().cluster(cluster);
        std::array<Double3, 3> corners;
        for (size_t i = 0; i < 3; ++i)
        {
            const uint32_t vertex = geometry.triangle(triangle)[i];
            const auto pose = moment.poses.find(instance);
            corners[i] = pose != moment.poses.end() ? posedVertex(geometry, vertex, pose->second).position
                                                    : transformPoint(widened(moment.places.at(instance)),
                                                                     widen(geometry.position(vertex)));
        }
        return corners;
    }

    /// Vector that a pixel of the last image should have, if rounding does not decide about it.
    std::optional<Vector> findExpected(const Moment& before, const Camera& camera, uint32_t pixel) const
    {
        const Double3 direction = findDirection(camera, pixel);
        Double3 shown = direction, earlier = direction;
        if (const auto& seen = seen_[pixel]; seen[0] != kInvalidIndex)
        {
            const auto now = findCorners(now_, seen), then = findCorners(before, seen);
            const Double3 normal = cross(now[1] - now[0], now[2] - now[0]);
            const Double3 eye = widen(camera.position);
            const double facing = dot(normal, direction);
            if (std::abs(facing) < 0.05 * length(normal) * length(direction))
                return std::nullopt; // the place on the triangle is a matter of rounding
            const Double3 point = eye + direction * (dot(normal, now[0] - eye) / facing);
            const double area = dot(normal, normal);
            const double second = dot(cross(point - now[0], now[2] - now[0]), normal) / area;
            const double third = dot(cross(now[1] - now[0], point - now[0]), normal) / area;
            shown = point - eye;
            earlier = then[0] * (1 - second - third) + then[1] * second + then[2] * third -
                      widen(before.camera.position);
        }
        const auto from = project(before.camera, earlier), to = project(camera, shown);
        if (!from)
            return Vector{kUnseen, kUnseen};
        return Vector{std::clamp(from->x - to->x, -kLongest, kLongest),
                      std::clamp(from->y - to->y, -kLongest, kLongest)};
    }

    struct Comparison
    {
        size_t sky = 0, surfaces = 0, unseen = 0, wrong = 0, moving = 0;
    };
    Comparison compare(const std::vector<Vector>& motion, const Moment& before, const Camera& camera) const
    {
        Comparison result;
        for (uint32_t pixel = 0; pixel < motion.size(); ++pixel)
        {
            const auto expected = findExpected(before, camera, pixel);
            if (!expected)
                continue;
            ++(seen_[pixel][0] == kInvalidIndex ? result.sky : result.surfaces);
            const double size = std::hypot(expected->x, expected->y);
            const double apart = std::hypot(motion[pixel].x - expected->x, motion[pixel].y - expected->y);
            result.unseen += expected->x == kUnseen ? 1 : 0;
            result.moving += size > 1 ? 1 : 0;
            // halves have 11 bits; pixels lie up to 1/256 beside their triangles
            result.wrong += apart > 0.03 + size * 0x1p-9 ? 1 : 0;
        }
        return result;
    }

    static double findLongest(const std::vector<Vector>& motion)
    {
        double longest = 0;
        for (const Vector& vector : motion)
            longest = std::max(longest, std::hypot(vector.x, vector.y));
        return longest;
    }

    /// Move all rocks by up to half a metre, and all joints by up to a tenth.
    void moveEverything()
    {
        for (auto& [instance, place] : now_.places)
            for (auto& row : place.m)
                row[3] += uniform(random_, -0.5f, 0.5f);
        for (auto& [instance, pose] : now_.poses)
        {
            pose.free = true;
            for (Affine3d& joint : pose.world_from_bind)
                for (auto& row : joint.m)
                    row[3] += double{uniform(random_, -0.1f, 0.1f)};
            for (float& weight : pose.morph_weights)
                weight += uniform(random_, -0.3f, 0.3f);
        }
    }

    std::mt19937 random_{91};
    DeformedScene test_;
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::MotionPass> pass_;
    Moment now_;
    std::vector<std::array<uint32_t, 3>> seen_; ///< of the last image
};

} // namespace

TEST_F(MotionVectorsTest, vectorsLeadToWhereThingsWere)
{
    gpu::FrameTargets targets = makeMotionTargets();
    EXPECT_EQ(findLongest(drawMotion(targets, now_.camera)), 0) << "the first frame";
    size_t sky = 0, surfaces = 0, moving = 0;
    for (int frame = 0; frame < 6; ++frame)
    {
        const Moment before = now_;
        moveEverything();
        now_.camera.position = now_.camera.position + Float3{0.1f, -0.05f, 0.2f};
        now_.camera.target = now_.camera.target + Float3{-0.2f, 0.1f, 0};
        now_.camera.y_fov_rad *= 1.01f;
        now_.camera.shift = {uniform(random_, -0.02f, 0.02f), uniform(random_, -0.02f, 0.02f)};
        const auto motion = drawMotion(targets, now_.camera);
        const Comparison compared = compare(motion, before, now_.camera);
        // slivers whose places are a matter of rounding
        EXPECT_LE(compared.wrong, compared.surfaces / 500) << "frame " << frame;
        sky += compared.sky;
        surfaces += compared.surfaces;
        moving += compared.moving;
    }
    EXPECT_GT(sky, 6 * kColumns * kRows / 4);
    EXPECT_GT(surfaces, 6 * kColumns * kRows / 10);
    EXPECT_GT(moving, sky);
}

TEST_F(MotionVectorsTest, whatRestsHasNone)
{
    gpu::FrameTargets targets = makeMotionTargets();
    (void)drawMotion(targets, now_.camera);
    moveEverything();
    (void)drawMotion(targets, now_.camera);
    for (int frame = 0; frame < 4; ++frame)
    {
        now_.camera.shift = {uniform(random_, -0.02f, 0.02f), uniform(random_, -0.02f, 0.02f)};
        EXPECT_LT(findLongest(drawMotion(targets, now_.camera)), 1e-3) << "jitter is no motion";
    }
}

TEST_F(MotionVectorsTest, everyCameraHasItsOwnFrameBefore)
{
    gpu::FrameTargets left = makeMotionTargets(), right = makeMotionTargets();
    Camera other = now_.camera;
    other.position = other.position + Float3{-3, 1, 0};
    (void)drawMotion(left, now_.camera);
    (void)drawMotion(right, other);
    for (int step = 0; step < 2; ++step)
    {
        const Moment before = now_;
        Moment other_before = before;
        other_before.camera = other;
        moveEverything();
        other.target = other.target + Float3{0.1f, 0, 0};
        Comparison compared = compare(drawMotion(left, now_.camera), before, now_.camera);
        EXPECT_LE(compared.wrong, compared.surfaces / 500);
        EXPECT_GT(compared.moving, compared.surfaces / 4);
        compared = compare(drawMotion(right, other), other_before, other);
        EXPECT_LE(compared.wrong, compared.surfaces / 500);
        EXPECT_GT(compared.moving, compared.surfaces / 4);
    }
}

TEST_F(MotionVectorsTest, whatWasBehindTheEyeIsToldApart)
{
    gpu::FrameTargets targets = makeMotionTargets();
    Camera camera = now_.camera;
    camera.target = camera.position * 2.0f; // away from everything
    (void)drawMotion(targets, camera);
    Moment before = now_;
    before.camera = camera;
    const auto motion = drawMotion(targets, now_.camera);
    const Comparison compared = compare(motion, before, now_.camera);
    EXPECT_GT(compared.unseen, motion.size() / 2);
    EXPECT_LE(compared.wrong, motion.size() / 500);
}

} // namespace hearth::test
