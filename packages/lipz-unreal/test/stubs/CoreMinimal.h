#pragma once

// The parts of Unreal's core that the plugin uses, with the behaviour that its documentation states.
#include "Containers/Strings.h"
#include "Containers/Collections.h"
#include "Containers/Pointers.h"
#include "Containers/Delegates.h"
#include "Misc/Logs.h"

#include <algorithm>
#include <cmath>

#define UCLASS(...)
#define USTRUCT(...)
#define UENUM(...)
#define UPROPERTY(...)
#define UFUNCTION(...)
#define WITH_EDITORONLY_DATA 1
#define LIPZ_API
#define LIPZEDITOR_API
#define GAME_API
#define THIRD_PARTY_INCLUDES_START
#define THIRD_PARTY_INCLUDES_END

// The header tool defines a macro for the line of each GENERATED_BODY.
#define STUB_PASTE_2(a, b, c, d) a##b##c##d
#define STUB_PASTE(a, b, c, d) STUB_PASTE_2(a, b, c, d)
#define GENERATED_BODY() STUB_PASTE(CURRENT_FILE_ID, _, __LINE__, _GENERATED_BODY)

struct FMath
{
	template <typename T> static T Max(T A, T B) { return std::max(A, B); }
	template <typename T> static T Min(T A, T B) { return std::min(A, B); }
	static bool IsFinite(double Value) { return std::isfinite(Value); }
	static double FloorToDouble(double Value) { return std::floor(Value); }
};
