/// @file Everything of the public interface.
#pragma once

#include "cairn/bodies.h"
#include "cairn/checkpoint.h"
#include "cairn/events.h"
#include "cairn/filter.h"
#include "cairn/material.h"
#include "cairn/mesh_file.h"
#include "cairn/motion.h"
#include "cairn/query.h"
#include "cairn/recording.h"
#include "cairn/scene.h"
#include "cairn/settings.h"
#include "cairn/shape.h"
#include "cairn/statistics.h"
#include "cairn/types.h"
#include "cairn/version.h"
#include "cairn/world.h"
