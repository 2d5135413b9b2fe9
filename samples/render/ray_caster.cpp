#include "samples/render/ray_caster.h"

#include <cstring>
#include <stdexcept>
#include <string>

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include "samples/render/embree_api.h"
#include "samples/render/surface.h"

namespace walr::render {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

// The user data of the filter function for a mesh with cut-outs.
struct CutOut {
  const Scene* scene;
  const Mesh* mesh;
};

// Embree calls this for every triangle that a ray hits; clearing `valid` lets the ray pass.
void passThroughHoles(const RTCFilterFunctionNArguments* arguments) {
  const auto& cutOut = *static_cast<const CutOut*>(arguments->geometryUserPtr);
  for (unsigned int i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) {
      continue;
    }
    const glm::vec2 barycentric(RTCHitN_u(arguments->hit, arguments->N, i), RTCHitN_v(arguments->hit, arguments->N, i));
    if (isHole(*cutOut.scene, *cutOut.mesh, RTCHitN_primID(arguments->hit, arguments->N, i), barycentric)) {
      arguments->valid[i] = 0;
    }
  }
}

RTCRay embreeRay(const Ray& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x;
  result.org_y = ray.origin.y;
  result.org_z = ray.origin.z;
  result.dir_x = ray.direction.x;
  result.dir_y = ray.direction.y;
  result.dir_z = ray.direction.z;
  result.tnear = 0.0F;
  result.tfar = ray.length;
  result.mask = ~0U;
  return result;
}

}  // namespace

class RayCaster::Impl {
 public:
  Impl(const Scene& scene, const std::vector<Instance>& instances)
      : scene_(scene), stillId_(static_cast<unsigned int>(instances.size())), device_(rtcNewDevice(nullptr)) {
    check("cannot be started");
    still_ = newScene();
    rtcSetSceneBuildQuality(still_.get(), RTC_BUILD_QUALITY_HIGH);
    for (const Mesh& mesh : scene.meshes) {
      cutOuts_.push_back({&scene, &mesh});
    }
    bool anyStill = false;
    std::vector<SceneHandle> meshScenes(scene.meshes.size());
    for (unsigned int i = 0; i < instances.size(); ++i) {
      if (!instances[i].moves) {
        attach(still_.get(), meshGeometry(instances[i].mesh, instances[i].worldFromObject), i);
        anyStill = true;
        continue;
      }
      SceneHandle& object = meshScenes[instances[i].mesh];
      if (!object) {
        object = newScene();
        attach(object.get(), meshGeometry(instances[i].mesh, glm::mat4(1.0F)), 0);
        rtcCommitScene(object.get());
      }
      moving_.push_back({i, instanceGeometry(object.get(), instances[i].worldFromObject)});
    }
    rtcCommitScene(still_.get());
    if (!moving_.empty()) {
      all_ = newScene();
      for (const Moving& moving : moving_) {
        rtcAttachGeometryByID(all_.get(), moving.geometry.get(), moving.instance);
      }
      if (anyStill) {
        attach(all_.get(), instanceGeometry(still_.get(), glm::mat4(1.0F)), stillId_);
      }
      rtcCommitScene(all_.get());
    }
    check("cannot build the scene");
  }

  void update(const std::vector<Instance>& instances) {
    for (const Moving& moving : moving_) {
      setTransform(moving.geometry.get(), instances[moving.instance].worldFromObject);
    }
    if (all_) {
      rtcCommitScene(all_.get());
    }
    check("cannot move the scene's objects");
  }

  [[nodiscard]] RTCScene root() const { return all_ ? all_.get() : still_.get(); }

  // Both the geometries of the still part and the instances in the top-level scene have the instance's index as their
  // id.
  [[nodiscard]] std::uint32_t instanceOf(const RTCHit& hit) const {
    const unsigned int over = hit.instID[0];
    return over == RTC_INVALID_GEOMETRY_ID || over == stillId_ ? hit.geomID : over;
  }

 private:
  struct Moving {
    unsigned int instance;
    Geometry geometry;
  };

  [[nodiscard]] SceneHandle newScene() const { return SceneHandle(rtcNewScene(device_.get())); }

  static void attach(RTCScene scene, const Geometry& geometry, unsigned int id) {
    rtcAttachGeometryByID(scene, geometry.get(), id);
  }

  Geometry meshGeometry(std::uint32_t meshIndex, const glm::mat4& worldFromObject) {
    const Mesh& mesh = scene_.meshes[meshIndex];
    Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
    if (vertices == nullptr || triangles == nullptr) {
      check("cannot allocate memory for " + mesh.name);
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      vertices[i] = glm::vec3(worldFromObject * glm::vec4(mesh.positions[i], 1.0F));
    }
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    if (scene_.materials[mesh.material].alphaCutoff) {
      rtcSetGeometryUserData(geometry.get(), &cutOuts_[meshIndex]);
      rtcSetGeometryIntersectFilterFunction(geometry.get(), &passThroughHoles);
      rtcSetGeometryOccludedFilterFunction(geometry.get(), &passThroughHoles);
    }
    rtcCommitGeometry(geometry.get());
    return geometry;
  }

  [[nodiscard]] Geometry instanceGeometry(RTCScene object, const glm::mat4& worldFromObject) const {
    Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), object);
    setTransform(geometry.get(), worldFromObject);
    return geometry;
  }

  static void setTransform(RTCGeometry geometry, const glm::mat4& worldFromObject) {
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, glm::value_ptr(worldFromObject));
    rtcCommitGeometry(geometry);
  }

  void check(const std::string& what) const {
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error != RTC_ERROR_NONE || !device_) {
      throw std::runtime_error("Embree " + what + ": error " + std::to_string(static_cast<int>(error)));
    }
  }

  const Scene& scene_;
  unsigned int stillId_;
  Device device_;
  std::vector<CutOut> cutOuts_;
  SceneHandle still_;
  SceneHandle all_;  // The still part and the moving instances; null if nothing moves.
  std::vector<Moving> moving_;
};

RayCaster::RayCaster(const Scene& scene, const std::vector<Instance>& instances)
    : impl_(std::make_unique<Impl>(scene, instances)) {}

RayCaster::~RayCaster() = default;

void RayCaster::update(const std::vector<Instance>& instances) {
  impl_->update(instances);
}

std::optional<Hit> RayCaster::closest(const Ray& ray) const {
  RTCRayHit query{};
  query.ray = embreeRay(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(impl_->root(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  return Hit{impl_->instanceOf(query.hit), query.hit.primID};
}

bool RayCaster::occluded(const Ray& ray) const {
  RTCRay query = embreeRay(ray);
  embree::occluded(impl_->root(), query);
  return query.tfar < 0.0F;
}

}  // namespace walr::render
