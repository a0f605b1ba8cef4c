#include "gpu/device.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <mutex>

namespace relievo::gpu {

// Layers report from any thread.
class MessageLog {
public:
    void add(std::string text) {
        const std::lock_guard lock(mutex_);
        texts_.push_back(std::move(text));
    }
    std::vector<std::string> texts() const {
        const std::lock_guard lock(mutex_);
        return texts_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<std::string> texts_;
};

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr const char* advice_drivers = "install a Vulkan driver; Mesa's software device (mesa-vulkan-drivers) runs on any machine";

vk::ApplicationInfo application() {
    return {.pApplicationName = "relievo",
            .applicationVersion = 1,
            .pEngineName = "relievo",
            .engineVersion = 1,
            .apiVersion = VK_API_VERSION_1_3};
}

// The first queue family that draws, computes and stamps times, or -1.
int find_queue_family(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    constexpr auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    for (std::size_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & wanted) == wanted && families[i].timestampValidBits > 0) return static_cast<int>(i);
    return -1;
}

std::string missing_features(const vk::raii::PhysicalDevice& physical) {
    if (physical.getProperties().apiVersion < VK_API_VERSION_1_3) return "Vulkan 1.3";
    const auto chain = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features>();
    const auto& features = chain.get<vk::PhysicalDeviceVulkan13Features>();
    if (!features.dynamicRendering) return "dynamic rendering";
    if (!features.synchronization2) return "synchronization2";
    if (find_queue_family(physical) < 0) return "a queue that draws, computes and stamps times";
    const auto linear = [&](vk::Format format) {
        return bool(physical.getFormatProperties(format).optimalTilingFeatures &
                    vk::FormatFeatureFlagBits::eSampledImageFilterLinear);
    };
    // Heights must keep their precision to the end: a 16-bit fallback would move hits by more than what is measured.
    if (!linear(vk::Format::eR32Sfloat) || !linear(vk::Format::eR32G32Sfloat)) return "linear filtering of 32-bit float textures";
    return {};
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical) {
    const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    const auto version = [](std::uint32_t v) {
        return std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)) + "." +
               std::to_string(VK_API_VERSION_PATCH(v));
    };
    DeviceInfo info;
    info.name = properties.deviceName.data();
    info.driver =
        std::string(driver.driverName.data()) + " " + driver.driverInfo.data() + ", Vulkan " + version(properties.apiVersion);
    info.software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    info.lacks = missing_features(physical);
    info.usable = info.lacks.empty();
    return info;
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string listing(const std::vector<DeviceInfo>& devices) {
    std::string text = "devices here:";
    for (const DeviceInfo& d : devices)
        text += "\n    " + d.name + (d.software ? " (software)" : "") + (d.usable ? "" : ", lacks " + d.lacks);
    return text;
}

// Index of the device that `choice` means (DeviceSettings::choice).
std::size_t choose(const std::vector<DeviceInfo>& devices, const std::string& choice) {
    if (devices.empty()) throw Error("use", "the GPU", "no Vulkan device was found", advice_drivers);
    const auto first = [&](auto&& matches) {
        return static_cast<std::size_t>(std::ranges::find_if(devices, [&](const DeviceInfo& d) { return d.usable && matches(d); }) -
                                        devices.begin());
    };
    const auto software = [](const DeviceInfo& d) { return d.software; };
    std::size_t found = devices.size();
    if (choice.empty()) {
        found = first([](const DeviceInfo& d) { return !d.software; });
        if (found == devices.size()) found = first(software);
        if (found == devices.size())
            throw Error("use", "the GPU", "no device has what relievo needs", listing(devices) + "\n  " + advice_drivers);
    } else {
        if (lower(choice) == "software") found = first(software);
        if (found == devices.size())
            found = first([&](const DeviceInfo& d) { return lower(d.name).find(lower(choice)) != std::string::npos; });
        if (found == devices.size())
            throw Error("use", "the device '" + choice + "'", "no usable device is called that", listing(devices));
    }
    return found;
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<MessageLog*>(user)->add(data->pMessage);
    return VK_FALSE;
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> devices;
    try {
        const vk::raii::Context context;
        const auto app = application();
        const vk::raii::Instance instance(context, vk::InstanceCreateInfo{.pApplicationInfo = &app});
        for (const auto& physical : vk::raii::PhysicalDevices(instance)) devices.push_back(describe(physical));
    } catch (const vk::SystemError&) {
        // No driver at all is an answer, not a failure: the list is empty.
    }
    return devices;
}

DeviceInfo chosen_device(const std::string& choice) {
    const std::vector<DeviceInfo> devices = list_devices();
    return devices[choose(devices, choice)];
}

Device::Device(const DeviceSettings& settings) : messages_(std::make_unique<MessageLog>()) {
    try {
        context_.emplace();
    } catch (const std::exception& e) {
        throw Error("use", "the GPU", e.what(), advice_drivers);
    }
    const auto app = application();
    std::vector<const char*> layers;
    auto extensions = settings.instance_extensions;
    const vk::DebugUtilsMessengerCreateInfoEXT messenger{
        .messageSeverity = vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning | vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
        .messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation,
        .pfnUserCallback = collect,
        .pUserData = messages_.get()};
    // Hazards between our own passes are what layers find best, but only when asked.
    const auto hazards = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    const vk::ValidationFeaturesEXT validation{
        .pNext = &messenger, .enabledValidationFeatureCount = 1, .pEnabledValidationFeatures = &hazards};
    if (settings.validation) {
        const auto available = context_->enumerateInstanceLayerProperties();
        if (std::ranges::none_of(available, [](const auto& l) { return std::strcmp(l.layerName, validation_layer) == 0; }))
            throw Error("validate", "Vulkan calls", std::string("the layer ") + validation_layer + " is not installed",
                        "install vulkan-validationlayers, or go without validation");
        layers.push_back(validation_layer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    try {
        instance_ = vk::raii::Instance(
            *context_, vk::InstanceCreateInfo{.pNext = settings.validation ? &validation : nullptr,
                                              .pApplicationInfo = &app,
                                              .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
                                              .ppEnabledLayerNames = layers.data(),
                                              .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                              .ppEnabledExtensionNames = extensions.data()});
    } catch (const vk::SystemError& e) {
        throw Error("use", "the GPU", e.what(), advice_drivers);
    }
    if (settings.validation) messenger_ = vk::raii::DebugUtilsMessengerEXT(instance_, messenger);

    vulkan_errors_as("start", "the device '" + settings.choice + "'", [&] {
        std::vector<vk::raii::PhysicalDevice> candidates;
        std::vector<DeviceInfo> infos;
        for (auto& physical : vk::raii::PhysicalDevices(instance_)) {
            infos.push_back(describe(physical));
            candidates.push_back(std::move(physical));
        }
        const std::size_t chosen = choose(infos, settings.choice);
        info_ = infos[chosen];
        physical_ = std::move(candidates[chosen]);
        queue_family_ = static_cast<std::uint32_t>(find_queue_family(physical_));
        nanoseconds_per_tick_ = physical_.getProperties().limits.timestampPeriod;

        const float priority = 1;
        const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = queue_family_, .queueCount = 1, .pQueuePriorities = &priority};
        // maintenance4 because SPIR-V 1.6 states a workgroup's size in the way that it brings; Vulkan 1.3 devices all have it.
        const auto offered = physical_.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
        has_wide_atomics_ = offered.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 && offered.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics;
        vk::PhysicalDeviceVulkan12Features atomics{.shaderBufferInt64Atomics = has_wide_atomics_};
        const vk::PhysicalDeviceVulkan13Features features{.pNext = &atomics, .synchronization2 = true, .dynamicRendering = true, .maintenance4 = true};
        counts_vertices_ = physical_.getFeatures().pipelineStatisticsQuery;
        const vk::PhysicalDeviceFeatures basic{.pipelineStatisticsQuery = counts_vertices_, .shaderInt64 = has_wide_atomics_};
        device_ = vk::raii::Device(
            physical_, vk::DeviceCreateInfo{.pNext = &features,
                                            .queueCreateInfoCount = 1,
                                            .pQueueCreateInfos = &queue,
                                            .enabledExtensionCount = static_cast<std::uint32_t>(settings.device_extensions.size()),
                                            .ppEnabledExtensionNames = settings.device_extensions.data(),
                                            .pEnabledFeatures = &basic});
        queue_ = device_.getQueue(queue_family_, 0);
        pool_ = vk::raii::CommandPool(device_, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eTransient,
                                                                         .queueFamilyIndex = queue_family_});
    });
}

Device::~Device() = default;

std::vector<std::string> Device::validation_messages() const { return messages_->texts(); }

void Device::run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const {
    const vk::raii::CommandBuffers buffers(
        device_, {.commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
    const vk::raii::CommandBuffer& commands = buffers.front();
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    commands.end();
    const vk::raii::Fence done(device_, vk::FenceCreateInfo{});
    const vk::CommandBufferSubmitInfo submitted{.commandBuffer = *commands};
    queue_.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &submitted}, *done);
    // A software device may take minutes for a large picture; a device that hangs is reported by the driver as lost.
    const auto result = device_.waitForFences(*done, true, std::numeric_limits<std::uint64_t>::max());
    if (result != vk::Result::eSuccess) throw Error("run", "commands on " + info_.name, vk::to_string(result));
}

std::uint32_t Device::memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags wanted) const {
    const auto memory = physical_.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed & (1u << i)) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    throw Error("allocate", "memory on " + info_.name, "it has no memory that is " + vk::to_string(wanted));
}

void full_barrier(const vk::raii::CommandBuffer& commands) {
    const vk::MemoryBarrier2 all{
        .srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
        .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
        .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands | vk::PipelineStageFlagBits2::eHost,
        .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite | vk::AccessFlagBits2::eHostRead};
    commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &all});
}

}  // namespace relievo::gpu
