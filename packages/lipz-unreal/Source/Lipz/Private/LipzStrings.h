#pragma once

#include "CoreMinimal.h"

#include "LipzDialogue.h"

/** Strings of the C library, which are UTF-8 without terminator, as strings of Unreal. */
namespace LipzStrings
{
	FString ToFString(const lipz_string& String);

	/** Returns None for a name that is too long for an FName, which would stop the engine. */
	FName ToFName(const lipz_string& String);

	/** The English sentence about a status, without a full stop. */
	FString Message(lipz_status Status);
}
