// Vulkan as this project uses it: RAII handles, exceptions, designated initializers. Seen only by gpu, render and viewer.
#pragma once

#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>
