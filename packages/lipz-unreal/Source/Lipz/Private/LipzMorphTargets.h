#pragma once

#include "CoreMinimal.h"

class USkeletalMeshComponent;

/** The morph targets of a mesh that take weights. */
class FLipzMorphTargets
{
public:
	/**
	 * Finds the morph target for each weight: the one in Renamed, or the one with the most similar name. Returns the
	 * names of weights without a morph target.
	 */
	TArray<FName> Find(USkeletalMeshComponent* Mesh, const TArray<FName>& Weights, const TMap<FName, FName>& Renamed);

	/** Writes the weights. A weight of 0 lets the animation of the mesh show. */
	void Show(USkeletalMeshComponent* Mesh, const TArray<float>& Values) const;

	/** The number of weights that have a morph target. */
	int32 Num() const { return Targets.Num(); }

private:
	/** The index of a weight, and the name of its morph target. */
	TArray<TPair<int32, FName>> Targets;
};
