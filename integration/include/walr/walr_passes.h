/*
 * A method or a single stage of one spelled out, for engines that schedule and record by themselves: passes, what they
 * read and write, and everything that is needed to run them, as plain data.
 *
 * Two ways to use it:
 * - Pass by pass: each pass becomes one of the host's graph. The host makes every resource of the list, orders the
 *   passes, places barriers, swaps histories, and calls walr_record_pass from each, which binds and dispatches and does
 *   nothing else.
 * - A dispatch list: the host makes the pipelines itself from what it finds here and need not even give a device. The
 *   list's order, barriers and places in shared heaps may be used as they are.
 */
#ifndef WALR_WALR_PASSES_H
#define WALR_WALR_PASSES_H

#include <walr/walr.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum WalrResourceKind {
  /* An image of the host's: "lighting", ..., "denoised", or, of a single stage, an input that has the port's name. */
  WALR_RESOURCE_HOST = 0,
  WALR_RESOURCE_TRANSIENT = 1,        /* Lives within the frame. */
  WALR_RESOURCE_HISTORY_PREVIOUS = 2, /* What the last frame wrote into `partner`. Nothing, on the first. */
  WALR_RESOURCE_HISTORY_CURRENT = 3,  /* Kept for the next frame, which finds it in `partner`. */
  WALR_RESOURCE_UPLOAD = 4,           /* A uniform buffer that is new every frame: walr_get_frame_constants. */
  WALR_RESOURCE_KIND_MAX = 0x7fffffff
} WalrResourceKind;

#define WALR_NONE 0xffffffffU

typedef struct WalrResource {
  uint32_t struct_size;
  WalrResourceKind kind;
  const char* name;
  VkBool32 used; /* Whether any pass touches it. */
  VkBool32 buffer;
  VkFormat format; /* Images only, as are width, height and image_usage. */
  uint32_t width;
  uint32_t height;
  VkImageUsageFlags image_usage; /* Union over all passes. */
  VkBufferUsageFlags buffer_usage;
  uint32_t partner;     /* Histories: index of the other one; WALR_NONE otherwise. */
  uint64_t buffer_size; /* Bytes; buffers only. */
  uint64_t memory_size; /* Bytes that the driver asks for; without a device, those of the texels. */
  uint32_t heap;        /* Transients that share memory: index of the heap; WALR_NONE otherwise. */
  uint32_t reserved;
  uint64_t heap_offset; /* Bytes. */
} WalrResource;

/* One variable of a shader, all in descriptor set 0. */
typedef struct WalrBinding {
  uint32_t struct_size;
  uint32_t binding;
  const char* name;
  VkDescriptorType type;
  uint32_t resource;           /* Index into WalrPassList::resources. A pass may bind one more than once. */
  VkPipelineStageFlags2 stage; /* In which the pass touches it, */
  VkAccessFlags2 access;       /* and how. */
  /* And in which layout unless the host says otherwise. GENERAL always does, and READ_ONLY_OPTIMAL in place of
   * SHADER_READ_ONLY_OPTIMAL. */
  VkImageLayout layout;
  VkFilter filter; /* Of combined image samplers, which clamp to the edge. */
} WalrBinding;

/* A VkImageMemoryBarrier2 or VkBufferMemoryBarrier2 of the whole resource. */
typedef struct WalrBarrier {
  uint32_t resource;
  uint32_t alias_of; /* The resource that had the memory before, where it changes hands; WALR_NONE otherwise. */
  VkPipelineStageFlags2 src_stage;
  VkAccessFlags2 src_access;
  VkPipelineStageFlags2 dst_stage;
  VkAccessFlags2 dst_access;
  VkImageLayout old_layout;
  VkImageLayout new_layout;
} WalrBarrier;

typedef struct WalrSpecialization {
  uint32_t constant_id;
  uint32_t value; /* 32 bits, be they of a uint, float or bool. */
} WalrSpecialization;

/* The age of a history, in frames, that the pass wants at an offset of its push constants; 0 while there is none. */
typedef struct WalrHistoryAge {
  uint32_t resource; /* The previous one. */
  uint32_t offset;   /* Bytes. */
} WalrHistoryAge;

/* One dispatch of a compute shader. */
typedef struct WalrDispatch {
  uint32_t struct_size;
  uint32_t binding_count;
  const char* name;   /* Of the pass; no other has it. */
  const char* shader; /* Name of the shader; passes of one name have the same SPIR-V. */
  const uint32_t* spirv;
  size_t spirv_size; /* Bytes. */
  const WalrBinding* const* bindings;
  const WalrSpecialization* specializations;
  const void* push_constants;
  const WalrHistoryAge* history_ages;
  const WalrBarrier* barriers; /* Before the dispatch, where the list's order and heaps are used. */
  uint32_t specialization_count;
  uint32_t push_constant_size; /* Bytes. */
  uint32_t history_age_count;
  uint32_t barrier_count;
  uint32_t group_count[3];
  /* Buffer with the group counts: index of a resource that one of the bindings is, too, whose stage and access then say
   * so; WALR_NONE usually. */
  uint32_t indirect;
  uint64_t indirect_offset;
} WalrDispatch;

typedef struct WalrHeap {
  uint64_t size;
  uint32_t memory_type_bits;
  uint32_t reserved;
} WalrHeap;

/* A port of a single stage: WalrPassType::ports. */
typedef struct WalrPortResource {
  const char* port;
  uint32_t resource; /* Index into WalrPassList::resources. */
  VkBool32 output;
} WalrPortResource;

typedef struct WalrPassList {
  uint32_t struct_size;
  uint32_t resource_count;
  const WalrResource* const* resources;
  const WalrDispatch* const* passes; /* In an order that works. */
  const WalrBarrier* releases;       /* After the last pass. */
  const WalrHeap* heaps;
  uint32_t pass_count;
  uint32_t release_count;
  uint32_t heap_count;
  uint32_t reserved;
  const WalrPortResource* ports; /* Of a single stage; none of a method. */
  uint32_t port_count;
  uint32_t reserved2;
} WalrPassList;

typedef struct WalrPasses_T* WalrPasses;

typedef struct WalrSettingValue {
  const char* name;
  const char* value;
} WalrSettingValue;

/* What is connected to an input of a single stage, where it is not of WalrPort::format. Formats of the host's own
 * images are in WalrDenoiserInfo. */
typedef struct WalrPortFormat {
  const char* port;
  VkFormat format;
  uint32_t reserved;
} WalrPortFormat;

typedef struct WalrPassesInfo {
  uint32_t struct_size;
  uint32_t setting_count;
  /* Its method may be the name of any WalrPassType. Its device may be null where no pass is to be recorded. */
  const WalrDenoiserInfo* denoiser;
  const WalrSettingValue* settings;
  const WalrPortFormat* ports; /* Of a single stage; optional. */
  uint32_t port_count;
  uint32_t reserved;
} WalrPassesInfo;

/*
 * Passes of a whole method, or of a single stage (a WalrPassType that is no method), from which a host builds a method
 * of its own:
 * - An output of one stage goes into the inputs of the same name of those that follow: the host gives the image behind
 *   the one port (WalrPassList::ports) for the other, in place of a WALR_RESOURCE_HOST. Such an image is made with the
 *   usage of all resources that it stands for, and lives until the last of these stages has read it.
 * - An output that is a previous history ("guides.previous-depth") is what the last frame wrote into its partner. In
 * the first frame, and where the past is of no use, give an image of zeros for it to the stages that follow.
 * - A stage takes images in walr's own conventions: WalrConventions may state only normal_space, motion_unit,
 *   motion_scale, motion_jittered and a static scene's motion_depth.
 * - Every stage's frame is begun with the same camera.
 */
WALR_API WalrResult walr_create_passes(const WalrPassesInfo* info, WalrPasses* passes);
/* The GPU must have finished everything recorded. */
WALR_API WalrResult walr_destroy_passes(WalrPasses passes);
/* Everything in the list is valid until the passes are destroyed. */
WALR_API WalrResult walr_get_pass_list(WalrPasses passes, const WalrPassList** list);

/* Let the next frame of passes go on from the last frame of others: its camera, its size and its number are taken over.
 * A list never changes, so a host that changes a setting or the size makes new passes and lets them go on from the old.
 * What those wrote as current histories is then to be given as previous ones of the same name and format; where the old
 * passes have no such history, null is. Both must be of one method, and of one size unless WalrConventions::rectangle
 * is stated. Passes of several sizes may take turns. WalrDenoiserInfo::pipeline_cache spares the pipelines that were
 * there before from being compiled again. */
WALR_API WalrResult walr_continue_passes(WalrPasses passes, WalrPasses last);

typedef struct WalrPassFrame {
  uint32_t struct_size;
  float sky_depth; /* As in WalrFrame. */
  const WalrCamera* camera;
  const WalrCamera* previous_camera; /* Null stands for the camera of the frame before. */
  float pre_exposure;                /* As in WalrFrame. */
  uint32_t reserved;
  uint32_t offset[2]; /* As in WalrFrame. */
} WalrPassFrame;

/* Begin a frame: to be called once before its passes are recorded. The GPU must have finished the frame that was begun
 * `frames_in_flight` frames earlier. */
WALR_API WalrResult walr_begin_frame(WalrPasses passes, const WalrPassFrame* frame);

/* Contents of an upload buffer for the frame begun last, for hosts that bind it themselves.
 * resource: index of a WALR_RESOURCE_UPLOAD
 * size: in: bytes at `bytes`; out: bytes needed. `bytes` may be null. */
WALR_API WalrResult walr_get_frame_constants(WalrPasses passes, uint32_t resource, void* bytes, size_t* size);

/* What the host binds. */
typedef struct WalrPassResource {
  VkImage image;     /* Null for a history of which there is no last frame: zeros are read. */
  VkBuffer buffer;   /* Of buffers, but not of uploads, which are the library's. */
  uint64_t identity; /* As in WalrImage. */
  VkImageLayout layout;
  uint32_t reserved;
} WalrPassResource;

/*
 * Bind and dispatch a pass. Passes of a frame may be recorded in any order and into different command buffers,
 * secondary ones too, so long as the GPU comes to them in the list's order or another that works. There is no barrier
 * in it, save for the zeros of a history that is null: everything that it touches must be in the given layout, visible
 * to the binding's stage and access, and stay so until others wait for it. resources: one for each of the pass's
 * bindings, in their order.
 */
WALR_API WalrResult walr_record_pass(WalrPasses passes, uint32_t pass, VkCommandBuffer command_buffer,
                                     const WalrPassResource* resources, uint32_t resource_count);

/* Destroy the views of an image; see walr_forget_image. */
WALR_API WalrResult walr_forget_pass_image(WalrPasses passes, VkImage image, uint64_t identity);

#ifdef __cplusplus
}
#endif
#endif
