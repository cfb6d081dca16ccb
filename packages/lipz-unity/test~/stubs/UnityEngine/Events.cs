// Events of UnityEngine.
using System.Collections.Generic;

namespace UnityEngine.Events
{
    public delegate void UnityAction();

    public delegate void UnityAction<T0>(T0 arg0);

    public delegate void UnityAction<T0, T1, T2>(T0 arg0, T1 arg1, T2 arg2);

    public abstract class UnityEventBase
    {
    }

    public class UnityEvent : UnityEventBase
    {
        private readonly List<UnityAction> calls = new List<UnityAction>();

        public void AddListener(UnityAction call)
        {
            calls.Add(call);
        }

        public void Invoke()
        {
            for (int i = 0; i < calls.Count; i++) calls[i]();
        }
    }

    public class UnityEvent<T0> : UnityEventBase
    {
        private readonly List<UnityAction<T0>> calls = new List<UnityAction<T0>>();

        public void AddListener(UnityAction<T0> call)
        {
            calls.Add(call);
        }

        public void Invoke(T0 arg0)
        {
            for (int i = 0; i < calls.Count; i++) calls[i](arg0);
        }
    }

    public class UnityEvent<T0, T1, T2> : UnityEventBase
    {
        private readonly List<UnityAction<T0, T1, T2>> calls = new List<UnityAction<T0, T1, T2>>();

        public void AddListener(UnityAction<T0, T1, T2> call)
        {
            calls.Add(call);
        }

        public void Invoke(T0 arg0, T1 arg1, T2 arg2)
        {
            for (int i = 0; i < calls.Count; i++) calls[i](arg0, arg1, arg2);
        }
    }
}
