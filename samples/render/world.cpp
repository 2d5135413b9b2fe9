#include "samples/render/world.h"

namespace walr::render {

World::World(const Scene& scene, RayCasting rayCasting)
    : scene_(scene),
      nodes_(worldTransforms(scene, 0.0)),
      previousNodes_(nodes_),
      instances_(makeInstances(scene)),
      lights_(scene, instances_, nodes_),
      sky_(scene) {
  if (rayCasting == RayCasting::Embree) rays_.emplace(scene, instances_);
}

void World::moveTo(double seconds, double previousSeconds) {
  nodes_ = worldTransforms(scene_, seconds);
  previousNodes_ = worldTransforms(scene_, previousSeconds);
  placeInstances(scene_, nodes_, previousNodes_, instances_);
  if (rays_) rays_->update(instances_);
  lights_ = Lights(scene_, instances_, nodes_);
}

}  // namespace walr::render
