// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/caster.hpp"

#include <algorithm>
#include <array>
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
  if (world.surface.size() != world.triangles.size()) {
    throw std::invalid_argument("a world needs one surface for each triangle");
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

EmbreeScene make_scene(RTCDevice device, const World& world) {
  EmbreeScene scene{rtcNewScene(device)};
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  if (!world.triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill(geometry, world);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);  // the scene holds it
  }
  // One thread builds the tree, so that it is the same tree every time: where a ray meets an edge, the order
  // of the tree decides which of its triangles is hit. (Embree's own setting for this would hold for all of
  // the process for as long as the device lives.)
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  rtcCommitScene(scene.get());
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

struct Caster::State {
  World world;
  Device device;
  EmbreeScene scene;  // goes before the device
};

Caster::Caster(World world) {
  check(world);
  Device device = make_device();
  EmbreeScene scene = make_scene(device.get(), world);
  state_ = std::make_unique<const State>(State{std::move(world), std::move(device), std::move(scene)});
}

Caster::Caster(Caster&&) noexcept = default;
Caster& Caster::operator=(Caster&&) noexcept = default;
Caster::~Caster() = default;

std::optional<Hit> Caster::cast(Vec3 origin, Vec3 direction) const {
  RTCRayHit ray = make_ray(origin, direction);
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->scene.get(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const World& world = state_->world;
  const auto& corner = world.triangles[ray.hit.primID];
  const Vec3 a = world.vertices[corner[0]];
  const Vec3 normal = cross(world.vertices[corner[1]] - a, world.vertices[corner[2]] - a);
  const double approach = dot(normal, direction);
  if (approach == 0.0) return std::nullopt;  // seen edge-on: only rounding made it a hit
  return Hit{.distance_m = dot(normal, a - origin) / approach,
             .surface = world.surface[ray.hit.primID],
             .cos_incidence = std::fabs(approach) / norm(normal)};
}

}  // namespace verge::sim
