#pragma once

// Everything of the visorder library: meshes and files, scenes, sorters, what checks their orders, and what draws them.

#include "visorder/box.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/gl_platform.h"
#include "visorder/image.h"
#include "visorder/mesh.h"
#include "visorder/mesh_arrays.h"
#include "visorder/ray_caster.h"
#include "visorder/read_mesh.h"
#include "visorder/relation.h"
#include "visorder/renderer.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"
#include "visorder/sorter_options.h"
#include "visorder/sorters.h"
#include "visorder/transfer_function.h"
#include "visorder/version.h"
#include "visorder/view.h"
