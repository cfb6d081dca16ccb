#pragma once

#include "CoreMinimal.h"

/** Compares the names of weights with the names that artists give to morph targets. */
namespace LipzShapeNames
{
	/**
	 * Returns the index in Names of the name that is most similar to Weight, or INDEX_NONE. For `mouthSmileLeft`, it
	 * accepts `MouthSmileLeft`, `mouth_smile_left`, `blendShape1.mouthSmileLeft` and `mouthSmile_L`; for `aa`, also
	 * `viseme_aa`.
	 */
	int32 Find(const FString& Weight, const TArray<FString>& Names);
}
