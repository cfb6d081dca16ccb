#pragma once

#include "CoreMinimal.h"

#include "LipzDialogue.h"

/** The weights of a face during a clip: of a rig, or of each viseme without a rig, and the curves of the clip. */
class FLipzWeights
{
public:
	/** Prepares for a clip. Returns false if the bank has no such rig. Then the weights are those of visemes. */
	bool Begin(const FLipzDialogue& Dialogue, const lipz_clip& Clip, const FString& InRigName);

	/** Computes all weights at a time. */
	void Update(const FLipzDialogue& Dialogue, const lipz_clip& Clip, lipz_time Time, uint8 Viseme, const lipz_who& Who);

	/** Sets all weights to 0. */
	void Rest();

	/** The names of the weights: `jawOpen`, or `A` and so on and `rest` for visemes. */
	const TArray<FName>& GetNames() const { return Names; }

	/** One value for each name, usually from 0 to 1. */
	const TArray<float>& GetValues() const { return Values; }

private:
	void BeginRig(const FLipzDialogue& Dialogue, const FString& InRigName);
	void UpdateRig(const FLipzDialogue& Dialogue, const lipz_clip& Clip, lipz_time Time, const lipz_who& Who);
	void BeginVisemes(const lipz_clip& Clip);
	void BeginCurves(const FLipzDialogue& Dialogue, const lipz_clip& Clip);

	TArray<FName> Names;
	TArray<float> Values;
	/** The weights of the rig, in thousandths. */
	TArray<int32> Thousandths;
	/** The code of each viseme, without a rig. */
	TArray<uint8> Codes;
	/** For each curve that the rig lacks, its index in the clip and its last key. */
	TArray<uint32> Curves;
	TArray<lipz_curve_cursor> CurveCursors;
	FString RigName;
	lipz_rig Rig = {};
	bool bHasRig = false;
};
