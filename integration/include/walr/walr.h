/*
 * walr: a real-time denoiser for diffuse and specular light. C11 and C++.
 *
 * "The host" is the engine that calls this library. A denoiser records its passes into a command buffer of the host. It
 * allocates its own memory, or takes it from the host, and places the barriers between its passes. The host states the
 * layout and the last access of its images before the denoiser, and what they must be ready for afterwards.
 *
 * Rules that hold everywhere:
 * - Every function that can fail returns a WalrResult. walr_last_error() then returns a text that tells what is wrong
 *   and how to fix it. No wrong argument crashes, except pointers to memory that is not valid.
 * - Structures begin with `struct_size`, which the caller sets to sizeof; those without it never change. If the
 *   library is newer than the caller's header, fields that the caller lacks count as zero. An older library refuses
 *   nonzero fields that it does not know, also in `reserved`. Zero is every field's default. New fields come last.
 * - A VkBool32 must be VK_FALSE or VK_TRUE. Any other value is a WALR_ERROR_INVALID_ARGUMENT that names the field.
 * - Handles are never reused: using a destroyed one is always an error.
 * - Only one thread at a time may use a denoiser. A call during another thread's call returns
 *   WALR_ERROR_CONCURRENT_USE and does nothing. Different denoisers are independent, unless they share objects.
 * - Matrices are column-major and multiply column vectors. View space is right-handed, the camera looks down -Z.
 *   Image coordinates have x to the right and y down, in pixels. Pixel centres are at .5.
 */
#ifndef WALR_WALR_H
#define WALR_WALR_H

#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan_core.h>

/* With Windows' shared library, a host may define WALR_SHARED; it saves each call a jump. CMake's walr::shared does. */
#if defined(_WIN32) && defined(WALR_SHARED)
#define WALR_API __declspec(dllimport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define WALR_API __attribute__((visibility("default")))
#else
#define WALR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum WalrResult {
  WALR_SUCCESS = 0,
  WALR_ERROR_INVALID_ARGUMENT = -1, /* Null, out of range, or wrong size, format, usage or queue family. */
  WALR_ERROR_INVALID_HANDLE = -2,   /* Null, destroyed, or never created. */
  WALR_ERROR_STRUCT_SIZE = -3,      /* struct_size not set, or fields set that the library is too old for. */
  WALR_ERROR_CONCURRENT_USE = -4,   /* Another thread is using the object. */
  WALR_ERROR_WRONG_ORDER = -5,      /* Another call must come first; the text names it. */
  WALR_ERROR_UNSUPPORTED = -6,      /* The device lacks something, or cannot compile a shader; see the text. */
  WALR_ERROR_OUT_OF_MEMORY = -7,
  WALR_ERROR_DEVICE_LOST = -8,
  WALR_ERROR_INTERNAL = -9, /* A bug in the library. */
  WALR_RESULT_MAX = 0x7fffffff
} WalrResult;

/* The library's version, "major.minor.patch". */
WALR_API const char* walr_version(void);
/* Name of a result, for instance "WALR_ERROR_INVALID_HANDLE". */
WALR_API const char* walr_result_name(WalrResult result);
/* Text of the last error on this thread. Valid until the next call on this thread fails. Never null. */
WALR_API const char* walr_last_error(void);

/* ---- Pass types and settings ----------------------------------------------------------------------------------- */

typedef enum WalrSettingKind {
  WALR_SETTING_NUMBER = 0,
  WALR_SETTING_INTEGER = 1,
  WALR_SETTING_SWITCH = 2, /* "on" or "off" */
  WALR_SETTING_CHOICE = 3, /* One of `choices`. */
  WALR_SETTING_KIND_MAX = 0x7fffffff
} WalrSettingKind;

typedef struct WalrSetting {
  uint32_t struct_size;
  WalrSettingKind kind;
  const char* name;
  const char* default_value;  /* As walr_set_setting takes it. */
  double least;               /* Smallest value; numbers and integers only. */
  double most;                /* Largest value. */
  const char* const* choices; /* Switches and choices: all values. */
  uint32_t choice_count;
  VkFlags lights;          /* That it acts on: 1 << WalrLightKind of each. */
  const char* unit;        /* "frames", "pixels", "fraction of depth"; empty for a pure number. */
  const char* description; /* One line. */
  const char* source;      /* Paper and section, or "measured". */
} WalrSetting;

typedef struct WalrPort {
  uint32_t struct_size;
  VkBool32 output;
  const char* name;
  VkBool32 optional;    /* May be left unconnected: an output, or an input that is not read with default settings. */
  VkBool32 buffer;      /* A buffer, not an image. */
  VkFormat format;      /* The usual format; images only. */
  VkFlags image_usage;  /* Union over all passes; images only. */
  VkFlags buffer_usage; /* Union over all passes; buffers only. */
  uint32_t reserved;
  uint64_t buffer_size;    /* Bytes; buffers only. */
  const char* description; /* May be empty. */
} WalrPort;

/* A whole denoising method or a single stage of one. Both consist of passes and have ports and settings.
 * walr_create_passes creates either, walr_create_denoiser only whole methods. */
typedef struct WalrPassType {
  uint32_t struct_size;
  VkBool32 method; /* A whole method. */
  const char* name;
  const char* description;
  const WalrPort* const* ports;
  const WalrSetting* const* settings;
  const char* const* presets;
  const char* const* passes; /* Names of its passes with default settings. */
  uint32_t port_count;
  uint32_t setting_count;
  uint32_t preset_count;
  uint32_t pass_count;
} WalrPassType;

/* All pass types. No device is needed. Returned pointers are valid while the library is loaded. */
WALR_API uint32_t walr_pass_type_count(void);
/* Null if the index is out of range. */
WALR_API const WalrPassType* walr_pass_type(uint32_t index);

/* ---- The device ------------------------------------------------------------------------------------------------ */

/* A block of device memory that the library needs. Fields may be added at the end. */
typedef struct WalrMemoryRequest {
  uint32_t struct_size;      /* Size in the library. */
  uint32_t memory_type_bits; /* Allowed memory types: bit i for VkPhysicalDeviceMemoryProperties::memoryTypes[i]. */
  uint64_t size;             /* Bytes, above 0; a multiple of bufferImageGranularity. */
  /* Of the offset: a multiple of bufferImageGranularity, so that blocks share no page with the host's resources. */
  uint64_t alignment;
  VkMemoryPropertyFlags required;  /* With HOST_VISIBLE the host maps the block, see WalrMemoryBlock::mapped. */
  VkMemoryPropertyFlags preferred; /* Use other memory if no allowed type has these. */
  const char* user;                /* What uses it, for messages and captures. Valid during the call. */
} WalrMemoryRequest;

/* A block of device memory of the host: a whole VkDeviceMemory or a part of one. */
typedef struct WalrMemoryBlock {
  VkDeviceMemory memory;
  uint64_t offset; /* Bytes from the start of `memory`. */
  void* mapped;    /* Address of the block's first byte until it is freed; null unless HOST_VISIBLE is required. */
  void* token;     /* The host's own, for instance a VmaAllocation. */
} WalrMemoryBlock;

/* Both are called on the thread that calls the library, and must not call it. With several threads they may be called
 * at the same time, for different denoisers.
 * WalrAllocateMemory: `block` is zero before. Any result but VK_SUCCESS makes the library's function fail with
 * WALR_ERROR_OUT_OF_MEMORY; what it has allocated until then is freed.
 * WalrFreeMemory: `block` is what was allocated. Images and buffers in it are destroyed already. */
typedef VkResult (*WalrAllocateMemory)(void* user, const WalrMemoryRequest* request, WalrMemoryBlock* block);
typedef void (*WalrFreeMemory)(void* user, const WalrMemoryBlock* block);

/* The host's allocator of device memory. */
typedef struct WalrMemoryCallbacks {
  uint32_t struct_size;
  uint32_t reserved;
  void* user; /* Handed to both. It must outlive the objects that are created with it. */
  WalrAllocateMemory allocate;
  WalrFreeMemory free;
} WalrMemoryCallbacks;

/*
 * The host's device. It must have been created with the features synchronization2 (Vulkan 1.3, or
 * VK_KHR_synchronization2) and shaderStorageImageExtendedFormats. The library does not link to the Vulkan loader: it
 * gets all Vulkan functions from `get_instance_proc_addr`. Vulkan does not tell which features of a device are enabled,
 * so the library can check this only if it gets `create_info`. If that enables the feature shaderFloat16, the
 * convolutions of flnr compute in halves, which takes less time; the result changes by rounding.
 */
typedef struct WalrDevice {
  uint32_t struct_size;
  uint32_t queue_family; /* Family of the queue that gets all command buffers; must support compute. */
  VkInstance instance;
  VkPhysicalDevice physical_device;
  VkDevice device;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr;
  const VkAllocationCallbacks* allocator; /* For memory of the processor; optional. The struct is copied. */
  /* What `device` was created with; optional. It is read during the call only. */
  const VkDeviceCreateInfo* create_info;
  /* For all device memory; optional. The struct is copied. Null: the library calls vkAllocateMemory. */
  const WalrMemoryCallbacks* device_memory;
} WalrDevice;

/* WALR_ERROR_UNSUPPORTED if the device lacks something; the error text lists everything that is missing. Checks what
 * the physical device supports, and with WalrDevice::create_info also what is enabled. All functions that take a
 * WalrDevice check the same. */
WALR_API WalrResult walr_check_device(const WalrDevice* device);

/* ---- A denoiser ------------------------------------------------------------------------------------------------ */

typedef struct WalrDenoiser_T* WalrDenoiser;

typedef enum WalrSpace { WALR_SPACE_VIEW = 0, WALR_SPACE_WORLD = 1, WALR_SPACE_MAX = 0x7fffffff } WalrSpace;

typedef enum WalrMotionUnit {
  WALR_MOTION_PIXELS = 0,
  WALR_MOTION_PICTURES = 1, /* UV: 1 is the whole width or height of the image. */
  WALR_MOTION_UNIT_MAX = 0x7fffffff
} WalrMotionUnit;

typedef enum WalrMotionDepth {
  WALR_MOTION_DEPTH_GIVEN = 0,        /* The motion image's third channel: previous minus current view depth. */
  WALR_MOTION_DEPTH_STATIC_SCENE = 1, /* Computed from the cameras; right where only the camera moves. */
  WALR_MOTION_DEPTH_REVERSED = 2,     /* The third channel, as current minus previous view depth. */
  /* No third channel, and objects move: found among the depths of the last frame that motion.xy leads to. The depth of
   * a surface may change by a tenth of it from one frame to the next, besides what the camera changes. */
  WALR_MOTION_DEPTH_FOUND = 3,
  WALR_MOTION_DEPTH_MAX = 0x7fffffff
} WalrMotionDepth;

typedef enum WalrDepth {
  WALR_DEPTH_LINEAR = 0,          /* Distance along the view axis, above 0. */
  WALR_DEPTH_NEGATIVE_LINEAR = 1, /* z of view space. */
  /* z / w in Vulkan's clip space, computed with row z of WalrCamera::projection. Reversed z and an infinite far plane
   * work, too. */
  WALR_DEPTH_DEVICE = 2,
  WALR_DEPTH_MAX = 0x7fffffff
} WalrDepth;

typedef enum WalrNormals {
  WALR_NORMALS_SIGNED = 0,              /* Three channels in -1..1; all zero is sky. */
  WALR_NORMALS_UNSIGNED = 1,            /* Three channels in -1..1, stored as 0..1; all zero is sky. */
  WALR_NORMALS_OCTAHEDRAL_SIGNED = 2,   /* Octahedral map, pole on +z, two channels in -1..1; only depth marks sky. */
  WALR_NORMALS_OCTAHEDRAL_UNSIGNED = 3, /* The same, stored as 0..1. */
  WALR_NORMALS_MAX = 0x7fffffff
} WalrNormals;

/* The host's conventions for its images, stated when the denoiser is created. Each image that needs a conversion costs
 * one small pass; with all fields zero there is none. */
typedef struct WalrConventions {
  uint32_t struct_size;
  WalrSpace normal_space;
  WalrMotionUnit motion_unit;
  WalrMotionDepth motion_depth;
  /* Factors for motion.xy, such that previous = current + motion, y down. Zero means 1. Use -1 for both if the host's
   * motion is current - previous, and change the sign of y if its y is up. */
  float motion_scale[2];
  WalrDepth depth;
  WalrNormals normals;
  VkBool32 pre_exposed;     /* The lighting is multiplied by WalrFrame::pre_exposure, and so is the result. */
  VkBool32 motion_jittered; /* motion.xy includes the jitter of both frames; by default it includes none. */
  /* Only a rectangle of the images is denoised. It starts at WalrFrame::offset. Its size (walr_resize) may change from
   * frame to frame, and the history is kept. Motion is measured in the current rectangle: a surface that keeps its
   * relative position in the rectangle has no motion, even if the size has changed. Jitter is in pixels of the
   * rectangle of its own frame. */
  VkBool32 rectangle;
  /* The cameras are orthographic. WALR_MOTION_DEPTH_STATIC_SCENE and WalrDenoiserInfo::lint are refused. If a zoom
   * doubles or halves the height of the view, the history may restart once. */
  VkBool32 orthographic;
  /* Sparse light: not every pixel of a frame has a sample. Methods that need all samples are refused. All other images
   * have the full size.
   * A texel of the lighting belongs to one pixel of a group of this width and height: 1 to 3, zero means 1. The
   * lighting is as large as the image divided by it, rounded up. Texel (i, j) is the sample of the pixel
   * (i * width, j * height) + WalrFrame::light_offset. If the height is 1, offsets in x move on by one pixel, modulo
   * the width, with every row: 2 x 1 is a checkerboard. A texel whose pixel lies outside the image is not read.
   * Not with `rectangle`. */
  uint32_t light_group[2];
  VkBool32 light_masked; /* The lighting has alpha. A texel whose alpha is not above 0 is no sample. */
  /* The same, and an alpha above 0 is the number of samples whose mean the colour is. Accumulation weighs light by it,
   * and history lengths are numbers of samples: see "Sparse light" in the integration guide. Fractions are allowed. NaN
   * and numbers below 0 are no sample. Numbers above 480 / accumulation.max-history count as that. */
  VkBool32 light_counted;
} WalrConventions;

/* What a light is that a denoiser takes. */
typedef enum WalrLightKind {
  WALR_LIGHT_DIFFUSE = 0, /* Light of the diffuse lobe, divided by WalrFrame::albedo. */
  /* Light of the specular lobe (reflections), divided by WalrFrame::specular_albedo. Its alpha is the distance from the
   * surface to what it reflects, scene units: 1e10 or infinity where the ray met nothing, 0 where there is no sample.
   * Refused are methods that take diffuse light only, orthographic cameras, light groups and counted light. */
  WALR_LIGHT_SPECULAR = 1,
  WALR_LIGHT_KIND_MAX = 0x7fffffff
} WalrLightKind;

typedef enum WalrLogLevel {
  WALR_LOG_INFO = 0,
  WALR_LOG_WARNING = 1,
  WALR_LOG_ERROR = 2,
  WALR_LOG_LEVEL_MAX = 0x7fffffff
} WalrLogLevel;

/* Called on the thread that calls the library. It must not call the library. */
typedef void (*WalrLog)(void* user, WalrLogLevel level, const char* text);

typedef struct WalrDenoiserInfo {
  uint32_t struct_size;
  uint32_t frames_in_flight; /* Frames that may be recorded before the GPU finishes the first, at most 16; 0 means 2. */
  const WalrDevice* device;
  const char* method; /* Null means "walr". */
  const char* preset; /* Null means the method's first. */
  /* Pixels, 1 to 16384. Less if a method needs a buffer of more than 128 MiB; the error then names it. */
  uint32_t width;
  uint32_t height;
  const WalrConventions* conventions; /* Null means all zero. */
  /* Formats of the host's images; VK_FORMAT_UNDEFINED means the usual one, see WalrPort::format. Any other must be
   * sampled as floats and have at least as many channels as are read. */
  VkFormat lighting_format; /* SFLOAT with four channels if alpha is a distance (specular light) or a count. */
  VkFormat depth_format;
  VkFormat normal_format;
  VkFormat motion_format;
  VkFormat albedo_format;
  VkBool32 timestamps; /* Measure the GPU time of every pass. Logs a warning if the queue family has no timestamps. */
  WalrLog log;         /* Optional. */
  void* log_user;
  VkFormat object_id_format; /* Of WalrFrame::object_id, unsigned integers; VK_FORMAT_UNDEFINED: no such image. */
  VkBool32 lint;             /* Check the inputs of every frame, see walr_get_findings. For debugging: costs passes. */
  /* Used for all pipelines; optional. It must outlive the object that is created with it. To avoid compilation at the
   * next start, save the result of vkGetPipelineCacheData and create the cache from it. */
  VkPipelineCache pipeline_cache;
  /* Format of the result: VK_FORMAT_R16G16B16A16_SFLOAT (or VK_FORMAT_UNDEFINED), VK_FORMAT_B10G11R11_UFLOAT_PACK32 or
   * VK_FORMAT_R32G32B32A32_SFLOAT. The last two cost a small pass, which rounds to the nearest value. */
  VkFormat denoised_format;
  VkBool32 counters;          /* Count what the method does, see walr_get_counters. For debugging: costs passes. */
  VkFormat confidence_format; /* Of WalrFrame::confidence, sampled as floats; VK_FORMAT_UNDEFINED: no such image. */
  VkBool32 history_length;    /* Write WalrFrame::history_length. It costs a small pass. */
  /* Another denoiser, for several views a frame (eyes, split screens, cube faces), or for lights of a view that
   * `light_count` does not allow to share guides; optional. Both share shader modules, pipelines and the memory of
   * transients; each has its own histories, size and settings. Use its device; its allocators and pipeline cache serve
   * both. Frames of both must be submitted in the order of recording, to one queue, and only one thread at a time may
   * use either. Both may be destroyed in any order. */
  WalrDenoiser shared_with;
  VkBool32 light_direction; /* Write WalrFrame::light_direction. It costs a small pass; method walr only. */
  /* Lights of one view (indirect and direct, or diffuse and specular): 1 or 2; 0 means 1. Two lights of one kind share
   * depth, normals, motion and albedo, which are prepared once, and the search for their history: methods without
   * guides are refused, and settings that decide which guides are made must be the same for both; the error text lists
   * them. Two kinds share the images only. Each light has its own histories and settings. The results are those of two
   * denoisers, to the bit. The images of the second light are WalrFrame::second_lighting and those after it; their
   * formats are those of the first. Counters are those of the first light, and so is the view unless its name begins
   * with "second."; lint checks the first light, and specular light. Single stages have one light. */
  uint32_t light_count;
  const char* second_preset; /* With two lights: the preset of the second. Null means `preset`. */
  VkBool32 expected_error;   /* Write WalrFrame::expected_error. It costs a small pass; method walr only. */
  uint32_t reserved;
  WalrLightKind light_kind;        /* Of WalrFrame::lighting. */
  WalrLightKind second_light_kind; /* Of WalrFrame::second_lighting. */
  /* Of WalrFrame::specular_albedo and WalrFrame::roughness, for specular light only; like `albedo_format`. */
  VkFormat specular_albedo_format;
  VkFormat roughness_format;
  VkFormat specular_motion_format; /* Of WalrFrame::specular_motion; VK_FORMAT_UNDEFINED: no such image. */
  uint32_t reserved2;
} WalrDenoiserInfo;

/* Creates no Vulkan object; see walr_prepare. */
WALR_API WalrResult walr_create_denoiser(const WalrDenoiserInfo* info, WalrDenoiser* denoiser);
/* The GPU must have finished everything recorded. */
WALR_API WalrResult walr_destroy_denoiser(WalrDenoiser denoiser);

/*
 * The next three functions take effect with the next walr_prepare or walr_record. The host need not wait for the GPU:
 * what frames in flight use is kept until they are finished.
 *
 * - Most settings change only numbers inside the passes. They keep the history and create no image and no memory. A
 *   pipeline is created only if a shader must be specialized for a value that it has not had yet.
 * - A setting that changes passes or textures creates new images and memory, and pipelines for new passes only. A
 *   history keeps its contents and length if the new passes have one of the same name and format. All others restart.
 * - A new size creates new images and memory, and a pipeline only where a shader is specialized by it. The
 *   history is kept if WalrConventions::rectangle is set, and dropped otherwise.
 */
WALR_API WalrResult walr_resize(WalrDenoiser denoiser, uint32_t width, uint32_t height);
/* With two lights: sets both, or the second alone: "second.blocks.residual". Refused if it acts on none of them. */
WALR_API WalrResult walr_set_setting(WalrDenoiser denoiser, const char* name, const char* value);
/* Replaces all settings. With two lights: of both, or of the second alone: "second.standard". */
WALR_API WalrResult walr_use_preset(WalrDenoiser denoiser, const char* name);

/* Current value of a setting as text, with its terminating zero. With two lights: that of the first, or with "second."
 * before the name that of the second.
 * size: in: bytes at `value`; out: bytes needed. `value` may be null. */
WALR_API WalrResult walr_get_setting(WalrDenoiser denoiser, const char* name, char* value, size_t* size);

/* Create memory and pipelines now, so that the next walr_record need not. */
WALR_API WalrResult walr_prepare(WalrDenoiser denoiser);

/* ---- Images ---------------------------------------------------------------------------------------------------- */

/* How the host must create an image. */
typedef struct WalrImageRequirements {
  uint32_t struct_size;
  VkBool32 required; /* Whether the denoiser uses it with its current settings. */
  VkFormat format;
  VkImageUsageFlags usage; /* Union over all passes. */
  uint32_t width;          /* Exact size; with WalrConventions::rectangle the least size. That of the lighting is
                              smaller with WalrConventions::light_group. */
  uint32_t height;
} WalrImageRequirements;

/* port: "lighting", "depth", "normal", "motion", "albedo", "object_id", "confidence", "denoised",
 * "view" (see walr_set_view), "history_length", "light_direction" or "expected_error"; with two lights also
 * "second_lighting", "second_confidence", "second_denoised", "second_history_length", "second_light_direction" or
 * "second_expected_error"; with specular light also "specular_albedo", "roughness" and "specular_motion".
 * Needs no image and no walr_prepare. */
WALR_API WalrResult walr_get_image_requirements(WalrDenoiser denoiser, const char* port,
                                                WalrImageRequirements* requirements);

/* State of an image at the border between the host's work and the denoiser's, as in a VkImageMemoryBarrier2. */
typedef struct WalrImageState {
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
  VkImageLayout layout;
  uint32_t reserved;
} WalrImageState;

/* An image of the host. Its views are created once for each identity and kept until walr_forget_image. */
typedef struct WalrImage {
  uint32_t struct_size;
  uint32_t queue_family; /* Owner: WalrDevice::queue_family or VK_QUEUE_FAMILY_IGNORED; both mean the same. */
  VkImage image;
  /* A number that no other image of the host has or will ever have. It is needed because Vulkan reuses handles. 0 means
   * the handle; such a host must call walr_forget_image before it destroys an image. */
  uint64_t identity;
  VkFormat format;
  VkImageUsageFlags usage; /* Flags that it was created with. */
  uint32_t width;
  uint32_t height;
  /* Before the denoiser: the last use of the image. For an output, and where the layout changes, this includes the last
   * reads. */
  WalrImageState acquire;
  /* After the denoiser: the next use of the image. With VK_IMAGE_LAYOUT_UNDEFINED, inputs keep the layout of `acquire`,
   * the output is left in GENERAL, and all are ready for any use that follows on the queue. An input for which
   * WalrImageRequirements::required is false stays as it was. */
  WalrImageState release;
} WalrImage;

/* The state in which the last walr_record left an image. */
WALR_API WalrResult walr_get_release_state(WalrDenoiser denoiser, const char* port, WalrImageState* state);

/* Destroy the views of an image. Call it before the image is destroyed and after the GPU has finished with it. */
WALR_API WalrResult walr_forget_image(WalrDenoiser denoiser, VkImage image, uint64_t identity);

/* ---- Frames ---------------------------------------------------------------------------------------------------- */

typedef struct WalrCamera {
  float view[16];       /* World to view space. */
  float projection[16]; /* View to clip space, without jitter, x right, y up; perspective, but see
                         * WalrConventions::orthographic. Row z is used with WALR_DEPTH_DEVICE only. */
  float jitter[2];      /* Pixels, y down: sample position minus pixel centre. */
} WalrCamera;

typedef enum WalrFrameFlags {
  WALR_FRAME_RESET_HISTORY = 1, /* Camera cut, or motion does not lead to the frame recorded last. */
  WALR_FRAME_INDEX_GIVEN = 2,   /* `frame_index` is set. */
  WALR_FRAME_FLAGS_MAX = 0x7fffffff
} WalrFrameFlags;

typedef struct WalrFrame {
  uint32_t struct_size;
  uint32_t flags; /* WalrFrameFlags */
  const WalrImage* lighting;
  const WalrImage* depth;
  const WalrImage* normal;
  const WalrImage* motion;
  const WalrImage* albedo;
  const WalrImage* denoised;
  const WalrCamera* camera;
  const WalrCamera* previous_camera; /* Null means the camera of the frame recorded last. */
  float sky_depth;                   /* Scene units: pixels at this view depth or beyond are sky. 0 means 1e9. */
  float pre_exposure; /* With WalrConventions::pre_exposed; 0 means 1. Light of more than 65504 counts as 65504. */
  const WalrImage* object_id; /* Optional, see WalrDenoiserInfo::object_id_format. */
  uint32_t offset[2];         /* With WalrConventions::rectangle: its first pixel, y down, the same in all images. */
  /* With WALR_FRAME_INDEX_GIVEN: seed of the frame's random numbers, so that a replay of the same frames has the same
   * result. It must rise by 1 with every frame of a denoiser, because parts of the picture take turns by it. Without
   * the flag it is the number of frames recorded before. */
  uint32_t frame_index;
  uint32_t reserved;
  const WalrImage* view; /* Receives the view that walr_set_view has chosen. Null if there is none. */
  /* Optional, see WalrDenoiserInfo::confidence_format: how much of its history of light a pixel may use, 0 to 1. The
   * longest history is multiplied by it. 0: none; 1, or NaN: as without the image. It does not concern
   * what is averaged after a filter: anti-aliasing, which clips its history, and the second accumulation of bmfr. */
  const WalrImage* confidence;
  /* With WalrDenoiserInfo::history_length: an R16F image of exactly the denoised size that receives the number of
   * frames, with this one, in the mean of each pixel's light; 0 where there is nothing to denoise. With
   * WalrConventions::light_counted: the number of samples. */
  const WalrImage* history_length;
  /* Large worlds: the position in the world, scene units, that `camera` is relative to (its view matrix takes positions
   * minus the origin), and the same of `previous_camera`; without that, `previous_origin` is not used. Any origin near
   * the camera will do, and it may change in every frame. At most 2^29 along each axis. */
  double origin[3];
  double previous_origin[3];
  /* Optional: a timeline semaphore that reaches `finished_value` when the GPU has finished this frame. When the frame's
   * slot is used again, walr_record reads it without waiting, and returns WALR_ERROR_WRONG_ORDER instead of a corrupted
   * picture if the GPU is not done. The device needs the feature timelineSemaphore. The semaphore must live until then,
   * or until the denoiser is destroyed. */
  VkSemaphore finished;
  uint64_t finished_value; /* Above 0, and never below that of the frame before with the same semaphore. */
  /* With WalrConventions::light_group: the pixel of each group that has the sample, y down. It should change from frame
   * to frame so that every pixel has its turn: x = frame % width, y = (frame / width + x) % height. */
  uint32_t light_offset[2];
  /* With WalrDenoiserInfo::light_direction: an R32G32_UINT image of exactly the denoised size that receives how each
   * pixel's light changes with the normal, see walr/light_direction.glsl. 0 where there is nothing to denoise. */
  const WalrImage* light_direction;
  /* With WalrDenoiserInfo::light_count of 2: the images of the second light. `second_lighting` and `second_denoised`
   * are required. The others are required where those of the first light are. */
  const WalrImage* second_lighting;
  const WalrImage* second_denoised;
  const WalrImage* second_confidence;
  const WalrImage* second_history_length;
  const WalrImage* second_light_direction;
  /* With WalrDenoiserInfo::expected_error: an R16F image of exactly the denoised size that receives the root mean
   * square error to expect of the result after the tone map x / (1 + x), 0 to 1, the same for all pixels of a tile of 8
   * x 8. 0 where there is nothing to denoise. See "Expected error" in the integration guide. */
  const WalrImage* expected_error;
  const WalrImage* second_expected_error;
  /* With WALR_LIGHT_SPECULAR: directional albedo of the specular lobe, by which the light was divided (see
   * walr/specular_albedo.h), and linear roughness as in glTF, 0 to 1. `albedo` is then read by diffuse light only. */
  const WalrImage* specular_albedo;
  const WalrImage* roughness;
  const WalrImage* specular_motion; /* Optional: previous minus current position of what is reflected, world space. */
} WalrFrame;

/*
 * Record one frame.
 *
 * Recorded frames must be submitted in the order of recording, all to one queue. Before a frame is recorded, the GPU
 * must have finished the one recorded `frames_in_flight` frames earlier: see WalrFrame::finished. If an error is
 * returned, nothing is recorded.
 *
 * command_buffer: in the recording state, outside of a render pass. Its bound compute pipeline, descriptor set 0 and
 * push constants are changed.
 */
WALR_API WalrResult walr_record(WalrDenoiser denoiser, VkCommandBuffer command_buffer, const WalrFrame* frame);

/* Drop all history before the next frame. */
WALR_API WalrResult walr_reset_history(WalrDenoiser denoiser);

/* ---- Memory, times and findings -------------------------------------------------------------------------------- */

typedef struct WalrMemory {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t allocated;           /* Bytes of device memory, from the driver or WalrDevice::device_memory. */
  uint64_t persistent;          /* Histories. */
  uint64_t transient;           /* Further memory for transients, which alias each other and histories. */
  uint64_t transient_unaliased; /* The same without aliasing. */
  uint64_t transient_least;     /* Lower bound of `transient`. */
  uint64_t retired;             /* Replaced, but still in use by frames in flight. */
  uint64_t shared; /* Bytes of `allocated` that other denoisers count, too: see WalrDenoiserInfo::shared_with. */
} WalrMemory;

/* Call walr_prepare or walr_record before. */
WALR_API WalrResult walr_get_memory(WalrDenoiser denoiser, WalrMemory* memory);

/* The memory that a denoiser with this description will allocate, before there is one: the result of walr_get_memory
 * after walr_prepare, where nothing is shared. It allocates no device memory. */
WALR_API WalrResult walr_query_memory(const WalrDenoiserInfo* info, WalrMemory* memory);

typedef struct WalrPassTime {
  const char* name; /* Valid until settings or size change. */
  double milliseconds;
} WalrPassTime;

/* GPU times of the last frame that was evaluated; none without WalrDenoiserInfo::timestamps. A frame is evaluated when
 * the one `frames_in_flight` after it is recorded. There are none until then. After a change of settings or size
 * that changes passes, walr_prepare or the next frame drops them until the next evaluation.
 * count: in: room at `times`; out: number of passes. `times` may be null. */
WALR_API WalrResult walr_get_timings(WalrDenoiser denoiser, uint32_t* count, WalrPassTime* times);

/* A likely fault in the host's images or matrices. Valid until the next call that takes the denoiser. */
typedef struct WalrFinding {
  const char* name;    /* Fixed, for programs: "motion-x-direction". */
  const char* what;    /* What was found, with measurements. */
  const char* cause;   /* The most likely cause. */
  const char* way_out; /* How to fix it. */
} WalrFinding;

/* Likely faults found in the frames that the GPU has finished; needs WalrDenoiserInfo::lint. A frame is evaluated when
 * the one `frames_in_flight` after it is recorded. A new finding is also logged. walr_prepare or the first frame at a
 * new size drops all findings, unless WalrConventions::rectangle is set.
 * count: in: room at `findings`; out: number of findings. `findings` may be null. */
WALR_API WalrResult walr_get_findings(WalrDenoiser denoiser, uint32_t* count, WalrFinding* findings);

/* ---- Views and counters ---------------------------------------------------------------------------------------- */

/* An image of an intermediate value of the method. */
typedef struct WalrView {
  const char* name;        /* As walr_set_view takes it. */
  const char* description; /* One line: what red, green and blue hold. */
} WalrView;

/* The views that all lights have with their current settings. The texts are valid while the library is loaded.
 * count: in: room at `views`; out: number of views. `views` may be null. */
WALR_API WalrResult walr_get_views(WalrDenoiser denoiser, uint32_t* count, WalrView* views);

/* Choose the view that the next frames write to WalrFrame::view: an RGBA32F image of exactly the denoised size. It
 * costs a pass that repeats the work of its stage, and takes effect like a setting that changes passes: the history is
 * kept. If a later setting removes the view, walr_record fails until another is chosen. name: of walr_get_views;
 * "NAME.T" is the view of iteration T where its stage iterates, and "NAME" that of the last. With two lights
 * "second.NAME" is the view of the second. Null: none, the default. */
WALR_API WalrResult walr_set_view(WalrDenoiser denoiser, const char* name);

/* How often something happened in a frame, for instance in how many pixels. */
typedef struct WalrCounter {
  const char* name; /* Valid until settings or size change. */
  uint64_t value;
} WalrCounter;

/* Counters of the last frame that was evaluated, see walr_get_timings: those of the method with
 * WalrDenoiserInfo::counters, and those of the inputs ("lint-...") with WalrDenoiserInfo::lint.
 * count: in: room at `counters`; out: number of counters. `counters` may be null. */
WALR_API WalrResult walr_get_counters(WalrDenoiser denoiser, uint32_t* count, WalrCounter* counters);

#ifdef __cplusplus
}
#endif
#endif
