#pragma once

// Everything of the visorder library that a program needs to order the cells of a mesh.

#include "checking/order_checker.h"
#include "files/read_mesh.h"
#include "scene/scene.h"
#include "scene/subdivision.h"
#include "scene/view.h"
#include "sorting/registry.h"
#include "version.h"
