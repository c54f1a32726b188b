// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/people/market_people.h"

#include "sample_assets/market/evening.h"
#include "sample_assets/market/pieces.h"
#include "sample_assets/market/street.h"
#include "sample_assets/people/character.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"

namespace hearth::samples
{

namespace
{

constexpr float kSkinCell = 0.02f; ///< of the characters: 4000 triangles each

/// Return a pose with hanging arms.
Pose relaxedPose()
{
    Pose pose = standingPose();
    for (const float side : {-1.0f, 1.0f})
    {
        pose.rotations[side < 0 ? kLeftUpperArm : kRightUpperArm] = rotationAbout({0, 0, 1}, side * 1.36f);
        pose.rotations[side < 0 ? kLeftForearm : kRightForearm] = rotationAbout({0, 1, 0}, side * 0.35f);
    }
    return pose;
}

/// Return a pose with both hands before the body, at a height that suits a handle or a counter.
/// turn_rad  of the forearms; more of it brings the hands together
Pose reachingPose(float lower_rad, float turn_rad)
{
    Pose pose = standingPose();
    const auto about = [](Float3 axis, float angle) { return rotationAbout(axis, angle); };
    pose.rotations[kLeftUpperArm] = multiply(about({0, 1, 0}, -0.9f), about({0, 0, 1}, -lower_rad));
    pose.rotations[kRightUpperArm] = multiply(about({0, 1, 0}, 0.9f), about({0, 0, 1}, lower_rad));
    pose.rotations[kLeftForearm] = about({0, 1, 0}, -turn_rad);
    pose.rotations[kRightForearm] = about({0, 1, 0}, turn_rad);
    return pose;
}

/// Return the mesh of a character in its bind pose, without a skin.
TriangleMesh takeStatue(const Pose& pose)
{
    Document studio;
    addCharacter(studio, pose, pose, 0.026f);
    TriangleMesh statue = studio.meshes.front().primitives.front().mesh;
    statue.joints.clear();
    statue.weights.clear();
    return statue;
}

/// Return the point of the ground below or above a point.
Float3 onGround(Float3 point)
{
    return {point.x, market::groundHeight({point.x, point.z}), point.z};
}

/// A person who does not move.
struct Bystander
{
    Placement placement;
    uint32_t pose = 0; ///< of kStandingPoses
    uint32_t dye = 0;
};
constexpr uint32_t kSelling = 0, kLooking = 1, kStrolling = 2, kStandingPoses = 3;
/// Factors of the colours of clothes.
constexpr std::array<Float3, 4> kDyes{
    {{1, 1, 1}, {1.9f, 0.75f, 0.6f}, {0.8f, 1.4f, 1.0f}, {2.2f, 1.9f, 1.3f}}};

/// Add a seller behind most counters, and guests before some.
void placeAtStalls(const market::Plan& plan, std::vector<Bystander>& people)
{
    for (uint32_t i = 0; i < plan.stalls.size(); ++i)
        for (const uint32_t pose : {kSelling, kLooking})
        {
            const auto random = [&](uint32_t which) { return randomUnit(i * 16 + pose * 8 + which, 1401); };
            if (random(0) > (pose == kSelling ? 0.85f : 0.6f))
                continue;
            const Float3 at = pose == kSelling
                                  ? Float3{1.2f * (random(2) - 0.5f), 0, -0.08f}
                                  : Float3{2.0f * (random(2) - 0.5f), 0, 1.75f + 0.3f * random(3)};
            const float turn = (pose == kSelling ? 0.0f : kPi) + 0.7f * (random(4) - 0.5f);
            const Placement& stall = plan.stalls[i].placement;
            Placement person =
                market::standing(market::fromPlacement(stall, at), 0, 0.94f + 0.12f * random(5));
            person.translation = onGround(person.translation);
            person.rotation = multiply(stall.rotation, rotationAbout({0, 1, 0}, turn));
            people.push_back({person, pose, static_cast<uint32_t>(random(1) * kDyes.size())});
        }
}

/// Add guests who stroll along the lanes, but for the front of the main street, where the characters are.
void placeInLanes(const market::Plan& plan, std::vector<Bystander>& people)
{
    for (uint32_t i = 0; i < plan.strings.size(); ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 8 + which, 1402); };
        const market::LampString& string = plan.strings[i];
        const bool is_main = string.from.x < 0 && string.to.x > 0;
        if (random(0) > 0.8f || (is_main && string.from.z > 8))
            continue;
        Float3 at = lerp(string.from, string.to, 0.3f + 0.4f * random(1));
        at = onGround({at.x, 0, at.z + 2.5f * (random(2) - 0.5f)});
        const float heading = (random(3) < 0.5f ? 0.0f : kPi) + 0.5f * (random(4) - 0.5f);
        people.push_back({market::standing(at, heading, 0.94f + 0.12f * random(5)), kStrolling,
                          static_cast<uint32_t>(random(6) * kDyes.size())});
    }
}

/// Add the people that do not move: one mesh for each pose and dye.
void addCrowd(Document& document, const market::Plan& plan)
{
    std::vector<Bystander> people;
    placeAtStalls(plan, people);
    placeInLanes(plan, people);
    const TriangleMesh statues[kStandingPoses] = {takeStatue(reachingPose(0.75f, 0.5f)),
                                                  takeStatue(relaxedPose()),
                                                  takeStatue(walkingPose(relaxedPose(), 0.2f))};
    Material material;
    material.name = "crowd";
    material.roughness = 0.8f;
    const int cloth = add(document.materials, material);
    for (uint32_t pose = 0; pose < kStandingPoses; ++pose)
        for (uint32_t dye = 0; dye < kDyes.size(); ++dye)
        {
            TriangleMesh statue = statues[pose];
            for (Float4& c : statue.colors)
                c = {std::min(1.0f, c.x * kDyes[dye].x), std::min(1.0f, c.y * kDyes[dye].y),
                     std::min(1.0f, c.z * kDyes[dye].z), 1};
            std::vector<Placement> placements;
            for (const Bystander& person : people)
                if (person.pose == pose && person.dye == dye)
                    placements.push_back(person.placement);
            if (!placements.empty())
                addCopies(document, "people", addMesh(document, "person", statue, cloth), placements);
        }
}

/// Add tracks of all joints that a pose, which is a function of the time, moves.
template <typename PoseAt>
void addPoseTracks(Animation& clip, const CharacterNodes& nodes, const PoseAt& pose_at)
{
    const std::vector<float> times = market::eveningTimes(8);
    Track hips{nodes.joints[kHips], TrackPath::translation, TrackKind::linear, times, {}};
    std::vector<Track> joints;
    for (const int joint : nodes.joints)
        joints.push_back({joint, TrackPath::rotation, TrackKind::linear, times, {}});
    for (const float time : times)
    {
        const Pose pose = pose_at(time);
        hips.values.push_back({pose.hips.x, pose.hips.y, pose.hips.z, 0});
        for (size_t joint = 0; joint < kJointCount; ++joint)
            joints[joint].values.push_back(pose.rotations[joint]);
    }
    clip.tracks.push_back(std::move(hips));
    for (Track& track : joints)
        if (!std::all_of(track.values.begin(), track.values.end(),
                         [&](const Float4& value) { return value == track.values.front(); }))
            clip.tracks.push_back(std::move(track));
}

void place(Document& document, const CharacterNodes& nodes, const Placement& placement)
{
    document.nodes[static_cast<size_t>(nodes.root)].placement = placement;
}

/// Add a character that pushes the cart.
void addCarter(Document& document, Animation& clip)
{
    const Pose pushing = reachingPose(0.62f, 0.25f);
    const CharacterNodes carter = addCharacter(document, walkingPose(pushing, 0), pushing, kSkinCell);
    const auto behind = [](float time) { return market::cartPosition(time) + Float3{0, 0, 1.98f}; };
    place(document, carter, market::standing(behind(0), kPi));
    Track way{carter.root, TrackPath::translation, TrackKind::linear, market::eveningTimes(2), {}};
    for (const float time : way.times)
        way.values.push_back({behind(time).x, behind(time).y, behind(time).z, 0});
    clip.tracks.push_back(std::move(way));
    addPoseTracks(clip, carter,
                  [&](float time)
                  {
                      Pose pose = walkingPose(pushing, time);
                      for (const Joint arm : {kLeftUpperArm, kRightUpperArm}) // hands stay on the handle
                          pose.rotations[arm] = pushing.rotations[arm];
                      return pose;
                  });
}

/// Add a guest in the middle of the street who looks around.
void addGuest(Document& document, Animation& clip)
{
    const Pose standing = relaxedPose();
    const CharacterNodes guest = addCharacter(document, standing, standing, kSkinCell);
    place(document, guest, market::standing(onGround({0.85f, 0, 16.6f}), kPi * 0.8f));
    addPoseTracks(clip, guest,
                  [&](float time)
                  {
                      Pose pose = standing;
                      const float angle = 2 * kPi * time / market::kEveningSeconds;
                      pose.rotations[kHead] = rotationAbout({0, 1, 0}, 0.7f * sine(angle));
                      pose.rotations[kSpine] = rotationAbout({0, 1, 0}, 0.2f * sine(angle));
                      pose.rotations[kChest] = rotationAbout({1, 0, 0}, 0.02f * sine(4 * angle));
                      return pose;
                  });
}

} // namespace

void addMarketPeople(Document& document, const market::Plan& plan, Animation& evening)
{
    addCrowd(document, plan);
    addCarter(document, evening);
    addGuest(document, evening);
}

} // namespace hearth::samples
