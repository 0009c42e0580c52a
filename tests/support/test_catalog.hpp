// The catalog of the test kit, under the name JET's own tests know.
#pragma once

#include <jet/testing/catalog.hpp>
