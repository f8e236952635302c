#pragma once

#include "core/data/mesh.h"

namespace gaitmill {

// The bones of the generic model in the frames of its bodies [m]: x forward, y up, z to the right,
// right side. Places come from what the model states: joint centres, muscle attachments, wrap
// cylinders and markers (Rajagopal et al. 2016); forms are this project's. Internal to core/render.

Mesh makePelvisBones();     ///< hip bones and sacrum
Mesh makeFemurBones();      ///< frame at the hip's centre
Mesh makeTibiaBones();      ///< with the fibula; frame at the knee's centre
Mesh makePatellaBones();    ///< frame at its lower end
Mesh makeTalusBones();      ///< frame at the ankle's centre
Mesh makeCalcaneusBones();  ///< with midfoot and metatarsals; frame behind and below the heel
Mesh makeToesBones();       ///< frame at the metatarsophalangeal joint
Mesh makeTorsoBones();      ///< spine, ribs, shoulder girdle and skull; frame at the lumbar joint
Mesh makeHumerusBones();    ///< frame at the shoulder's centre
Mesh makeUlnaBones();       ///< frame at the elbow
Mesh makeRadiusBones();     ///< frame at its head
Mesh makeHandBones();       ///< frame at the wrist; at the mesh scale of the generic model

/// A shaft from the origin to `end` with knobs at both ends.
Mesh makePlainShaft(const Eigen::Vector3d& end);

// Parts of the torso.
Mesh makeSpine();
Mesh makeRibcage();
Mesh makeShoulderGirdle();
Mesh makeSkull();

}  // namespace gaitmill
