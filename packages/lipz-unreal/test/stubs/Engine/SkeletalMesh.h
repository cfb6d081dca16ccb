#pragma once

#include "UObject/Object.h"

class UMorphTarget;

class USkeletalMesh : public UObject
{
	STUB_CLASS(USkeletalMesh, UObject)

	const TArray<TObjectPtr<UMorphTarget>>& GetMorphTargets() const { return StubTargets; }

	TArray<TObjectPtr<UMorphTarget>> StubTargets;
};
