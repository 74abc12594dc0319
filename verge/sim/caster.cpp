// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/caster.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <embree3/rtcore.h>
#include <tbb/global_control.h>

namespace verge::sim {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseScene>;

void check(const World& world) {
  if (world.surface.size() != world.triangles.size() || world.object.size() != world.triangles.size()) {
    throw std::invalid_argument("a world needs one surface and one object for each triangle");
  }
  for (const auto& triangle : world.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= world.vertices.size()) {
      throw std::invalid_argument("a triangle names a vertex that the world does not have");
    }
  }
}

Device make_device() {
  Device device{rtcNewDevice(nullptr)};
  if (!device) throw std::runtime_error("Embree gives no device");
  return device;
}

float* vertex_buffer(RTCGeometry geometry, std::size_t count) {
  return static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                     3 * sizeof(float), count));
}

std::uint32_t* index_buffer(RTCGeometry geometry, std::size_t count) {
  return static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
}

void fill(RTCGeometry geometry, const World& world) {
  float* vertex = vertex_buffer(geometry, world.vertices.size());
  std::uint32_t* index = index_buffer(geometry, world.triangles.size());
  if (vertex == nullptr || index == nullptr) throw std::runtime_error("Embree gives no buffer");
  for (const Vec3& p : world.vertices) {
    for (const double coordinate : std::array{p.x, p.y, p.z}) *vertex++ = static_cast<float>(coordinate);
  }
  for (const auto& triangle : world.triangles) index = std::copy(triangle.begin(), triangle.end(), index);
}

EmbreeScene new_scene(RTCDevice device) {
  EmbreeScene scene{rtcNewScene(device)};
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  return scene;
}

// One thread builds the tree, so that it is the same tree every time: where a ray meets an edge, the order of
// the tree decides which of its triangles is hit. (Embree's own setting for this would hold for all of the
// process for as long as the device lives.)
void commit(RTCScene scene) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  rtcCommitScene(scene);
}

EmbreeScene make_scene(RTCDevice device, const World& world) {
  EmbreeScene scene = new_scene(device);
  if (!world.triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill(geometry, world);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);  // the scene holds it
  }
  commit(scene.get());
  return scene;
}

RTCRayHit make_ray(Vec3 origin, Vec3 direction) {
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(origin.x);
  ray.ray.org_y = static_cast<float>(origin.y);
  ray.ray.org_z = static_cast<float>(origin.z);
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.dir_z = static_cast<float>(direction.z);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = std::numeric_limits<unsigned int>::max();
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace

/// A world and the tree over it.
struct Tree {
  World world;
  EmbreeScene scene;
};

struct Caster::Trees {
  Device device;  // goes after the scenes
  Tree still;
  std::vector<Tree> bodies;
};

struct Caster::Moment {
  EmbreeScene scene;               // the still world as instance 0, body i as instance i + 1
  std::vector<Pose> T_body_world;  // of each body
};

namespace {

void attach(RTCDevice device, RTCScene scene, RTCScene part, const Pose& T_world_part, unsigned int id) {
  RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, part);
  std::array<float, 12> columns{};
  const std::array<Vec3, 4> vectors = {
      rotate(T_world_part.rotation, {1.0, 0.0, 0.0}), rotate(T_world_part.rotation, {0.0, 1.0, 0.0}),
      rotate(T_world_part.rotation, {0.0, 0.0, 1.0}), T_world_part.translation};
  float* out = columns.data();
  for (const Vec3& v : vectors) {
    for (const double coordinate : std::array{v.x, v.y, v.z}) *out++ = static_cast<float>(coordinate);
  }
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  rtcCommitGeometry(instance);
  rtcAttachGeometryByID(scene, instance, id);
  rtcReleaseGeometry(instance);  // the scene holds it
}

// The hit on a triangle of `world`, exactly; none where it is seen edge-on: only rounding made that a hit.
std::optional<Hit> refine(const World& world, unsigned int triangle, Vec3 origin, Vec3 direction) {
  const auto& corner = world.triangles[triangle];
  const Vec3 a = world.vertices[corner[0]];
  const Vec3 normal = cross(world.vertices[corner[1]] - a, world.vertices[corner[2]] - a);
  const double approach = dot(normal, direction);
  if (approach == 0.0) return std::nullopt;
  const double scale = 1.0 / norm(normal);
  return Hit{.distance_m = dot(normal, a - origin) / approach,
             .surface = world.surface[triangle],
             .cos_incidence = std::fabs(approach) * scale,
             .object = world.object[triangle],
             .normal = scale * normal};
}

RTCIntersectContext make_context(RTCIntersectContextFlags flags) {
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  context.flags = flags;
  return context;
}

}  // namespace

Caster::Caster(World world, std::vector<World> bodies) {
  check(world);
  for (const World& body : bodies) check(body);
  auto trees = std::make_shared<Trees>();
  trees->device = make_device();
  EmbreeScene still = make_scene(trees->device.get(), world);
  trees->still = {std::move(world), std::move(still)};
  for (World& body : bodies) {
    EmbreeScene scene = make_scene(trees->device.get(), body);
    trees->bodies.push_back({std::move(body), std::move(scene)});
  }
  *this = Caster(std::move(trees), std::vector<Pose>(bodies.size()));
}

Caster::Caster(std::shared_ptr<const Trees> trees, std::span<const Pose> T_world_body)
    : trees_(std::move(trees)) {
  assert(T_world_body.size() == trees_->bodies.size());
  auto moment = std::make_unique<Moment>();
  if (!T_world_body.empty()) {
    RTCDevice device = trees_->device.get();
    moment->scene = new_scene(device);
    attach(device, moment->scene.get(), trees_->still.scene.get(), Pose{}, 0);
    for (std::size_t i = 0; i < T_world_body.size(); ++i) {
      const auto id = static_cast<unsigned int>(i + 1);
      attach(device, moment->scene.get(), trees_->bodies[i].scene.get(), T_world_body[i], id);
      moment->T_body_world.push_back(inverse(T_world_body[i]));
    }
    commit(moment->scene.get());
  }
  moment_ = std::move(moment);
}

Caster::Caster(Caster&&) noexcept = default;
Caster& Caster::operator=(Caster&&) noexcept = default;
Caster::~Caster() = default;

Caster Caster::at(std::span<const Pose> T_world_body) const { return {trees_, T_world_body}; }

std::optional<Hit> Caster::exact(unsigned int geometry, unsigned int instance, unsigned int triangle,
                                 const Ray& ray) const {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  if (instance == RTC_INVALID_GEOMETRY_ID || instance == 0) {
    return refine(trees_->still.world, triangle, ray.origin, ray.direction);
  }
  const std::size_t body = instance - 1;
  const Pose& T_body_world = moment_->T_body_world[body];
  auto hit = refine(trees_->bodies[body].world, triangle, T_body_world * ray.origin,
                    rotate(T_body_world.rotation, ray.direction));
  if (hit) hit->normal = rotate(inverse(T_body_world).rotation, hit->normal);
  return hit;
}

RTCSceneTy* Caster::scene() const {
  return moment_->scene ? moment_->scene.get() : trees_->still.scene.get();
}

std::optional<Hit> Caster::cast(Vec3 origin, Vec3 direction) const {
  RTCRayHit ray = make_ray(origin, direction);
  RTCIntersectContext context = make_context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  rtcIntersect1(scene(), &context, &ray);
  return exact(ray.hit.geomID, ray.hit.instID[0], ray.hit.primID, {origin, direction});
}

void Caster::cast(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const {
  assert(rays.size() == hits.size());
  constexpr std::size_t kLanes = 8;
  for (std::size_t begin = 0; begin < rays.size(); begin += kLanes) {
    const std::size_t count = std::min(kLanes, rays.size() - begin);
    alignas(32) RTCRayHit8 packet{};
    alignas(32) std::array<int, kLanes> valid{};
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[begin + i];
      valid[i] = -1;
      packet.ray.org_x[i] = static_cast<float>(ray.origin.x);
      packet.ray.org_y[i] = static_cast<float>(ray.origin.y);
      packet.ray.org_z[i] = static_cast<float>(ray.origin.z);
      packet.ray.dir_x[i] = static_cast<float>(ray.direction.x);
      packet.ray.dir_y[i] = static_cast<float>(ray.direction.y);
      packet.ray.dir_z[i] = static_cast<float>(ray.direction.z);
      packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
      packet.ray.mask[i] = std::numeric_limits<unsigned int>::max();
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context = make_context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcIntersect8(valid.data(), scene(), &context, &packet);
    for (std::size_t i = 0; i < count; ++i) {
      hits[begin + i] =
          exact(packet.hit.geomID[i], packet.hit.instID[0][i], packet.hit.primID[i], rays[begin + i]);
    }
  }
}

bool Caster::blocked(Vec3 from, Vec3 to, double margin_m) const {
  const Vec3 way = to - from;
  const double length = norm(way);
  if (length <= margin_m) return false;
  RTCRay ray = make_ray(from, (1.0 / length) * way).ray;
  ray.tfar = static_cast<float>(length - margin_m);
  RTCIntersectContext context = make_context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  rtcOccluded1(scene(), &context, &ray);
  return ray.tfar < 0.0F;
}

}  // namespace verge::sim
