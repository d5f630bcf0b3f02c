// own simulator: dq machine by co-energy, inverter with dead time, PI, sensors, dyno or free shaft
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <math.h>
#include <stdint.h>
#ifdef TABLE
#include TABLE
#endif
#define PI 3.14159265358979323846
static char **AV; static int AC;
static double P(const char*k,double d){size_t n=strlen(k);for(int i=AC-1;i>0;--i)if(!strncmp(AV[i],k,n)&&AV[i][n]=='=')return atof(AV[i]+n+1);return d;}
static uint64_t S=88172645463325252ull;
static double U(void){S^=S<<13;S^=S>>7;S^=S<<17;return (S>>11)*(1.0/9007199254740992.0);}
static double N(void){return sqrt(-2*log(U()+1e-300))*cos(2*PI*U());}
static int motor,p;
static double R,psi,Ld,Lq,J,coul,visc;
static double w(double d,double q,double th){
  if(motor==0){ // IPM, 48/8
    double Lqi=0.35e-3,Is=70,Lds=0.45e-3;
    double wv=psi*d*(1+0.006*cos(6*th)-0.004*cos(12*th))+psi*q*(0.007*sin(6*th)-0.004*sin(12*th)+0.0015*sin(18*th));
    wv+=0.5*Lds*d*d; double dd=d+40; wv+=-0.02e-3*60*60*(log(cosh(dd/60))-log(cosh(40/60.0)));
    wv+=0.5*Lqi*q*q+(Lq-Lqi)*Is*Is*(sqrt(1+q*q/Is/Is)-1);
    double x=q*q/(q*q+90.*90.); wv+=-0.10*psi*(d+60)*x;               // cross saturation
    wv+=(0.010e-3*q*q+0.008e-3*d*d)*cos(6*th)/(1+q*q/1e4)+0.020e-3*d*q*sin(6*th)-0.006e-3*q*q*cos(12*th);
    return wv;}
  if(motor==1) // 12/14 drone
    return psi*d*(1+0.003*cos(6*th+1))+0.5*Ld*(d*d+q*q)+psi*q*(0.004*sin(6*th+0.3)+0.001*sin(12*th));
  return psi*d*(1+0.004*cos(6*th+.5)+0.003*cos(12*th))+0.5*Ld*d*d+0.5*Lq*q*q-0.5*1e-5*q*q*q*q/12*.3+psi*q*(0.006*sin(6*th-0.6)+0.002*sin(12*th+.4)+.0008*sin(18*th)); // 9/6 servo
}
static double cog(double m){ // mech angle (zero on rising emf of a)
  if(motor==0) return 0.35*sin(48*m)-0.07*sin(96*m)+0.03*sin(24*m+2)+0.04*sin(8*m+0.7)+0.02*sin(47*m+1);
  if(motor==1) return 4.0e-3*sin(84*m+0.5)+0.7e-3*sin(168*m+2)+1.5e-3*sin(12*m+1.2)+1.0e-3*sin(14*m-0.4)+.4e-3*sin(24*m+.3)+.3e-3*sin(28*m+.3);
  return 0.045*sin(18*m+0.3)+0.012*sin(36*m+1.9)+0.010*sin(6*m-1)+0.006*sin(9*m+.4)+0.004*sin(54*m);
}
int main(int c,char**v){AC=c;AV=v;
  motor=(int)P("motor",0);
  double I0;
  if(motor==0){p=4;R=0.035;psi=0.09;Ld=0.45e-3;Lq=1.0e-3;J=0.006;coul=0.25;visc=0.002;I0=80;}
  else if(motor==1){p=7;R=0.11;psi=8.27/380/1.5/7;Ld=Lq=35e-6;J=2.2e-5;coul=1.8e-3;visc=1e-6;I0=15;}
  else {p=3;R=1.9;psi=0.2;Ld=7.5e-3;Lq=8.2e-3;J=1.4e-4;coul=0.03;visc=1e-4;I0=6;}
  psi*=P("psik",1);J*=P("Jk",1);S+=(uint64_t)P("seed",1)*7919*1000003;for(int i=0;i<20;++i)U();
  double Ts=1/P("fs",10e3);int sub=(int)P("sub",4);double h=Ts/sub;
  double T=P("T",5),rpm=P("rpm",60),id0=P("id",0),iq0=P("iq",0),torque=P("torque",0);int open=(int)P("open",0),usetab=(int)P("table",0),freeS=(int)P("free",0);
  double bw=2*PI*P("bw",500),Vdt=P("Vdt",motor==0?1.5:motor==1?0.15:2.0);
  double ga=P("ga",0),gb=P("gb",0),gc=P("gc",0),oa=P("oa",0),ob=P("ob",0),oc=P("oc",0),in=P("inoise",0);
  double e1=P("e1",0),e1p=P("e1p",0.5),e2=P("e2",0),e2p=P("e2p",1.0),cnt=P("counts",0),zero=P("zero",0)*PI/180/p; // rad mech error; zero elec deg
  double cga=P("cga",0),cgb=P("cgb",0),cgc=P("cgc",0),coa=P("coa",0),cob=P("cob",0),coc=P("coc",0);
  double ce2c=P("ce2c",0),ce2s=P("ce2s",0),ce1c=P("ce1c",0),ce1s=P("ce1s",0); // corrections, mech rad
  double lag=P("lag",0),aaf=2*PI*P("aaf",0),tn=P("tnoise",0),toff=P("toff",0),tdr=P("tdrift",0),tg=P("tgain",0),sr1=P("sr1",0),sr2=P("sr2",0),fres=P("fres",0);
  int every=(int)P("every",1);double skip=P("skip",0);
  double Ldn=Ld,Lqn=Lq,xd=0,xq=0,d=0,q=0,t=0,om=freeS?0:rpm*2*PI/60,m=P("m0",0.1),vd=0,vq=0;
  double f1=0,fa[3][2]={{0}},ft[2]={0};double ts=0,tsv=0;double wi=0,tref=m,vm=0;
  double poskp=P("poskp",20),velkp=P("velkp",0.002)*1,velki=P("velki",0.02),vf=0;double mlast=m,vest=0,acc=P("accel",3),vcmd=0;int phase=0;double turns=P("turns",1.2),start=m;double wait=0;
  printf("t,menc,mtrue,rpm,ia,ib,ic,torque,id,iq,Ttrue,idt,iqt,ea,iqref,Tshaft\n");
  long n=(long)(T/Ts);
  for(long k=0;k<n;++k){
    double eps=e1*sin(m+e1p)+e2*sin(2*m+e2p)+zero;
    double me=m+eps; if(cnt>0)me=floor(me*cnt/(2*PI))*2*PI/cnt;
    double mc=me-(ce1c*cos(me)+ce1s*sin(me)+ce2c*cos(2*me)+ce2s*sin(2*me));
    double th=p*mc, tt=p*m;
    // true phase currents
    double I[3],M[3],G[3]={1+ga,1+gb,1+gc},O[3]={oa,ob,oc},CG[3]={1+cga,1+cgb,1+cgc},CO[3]={coa,cob,coc};
    for(int j=0;j<3;++j){double a=tt-2*PI/3*j;I[j]=q*sin(a)-d*cos(a);M[j]=I[j]*G[j]+O[j]+in*N();}
    double Mc[3];for(int j=0;j<3;++j)Mc[j]=(M[j]-CO[j])/CG[j];
    double dm=0,qm=0;for(int j=0;j<3;++j){double a=th-2*PI/3*j;qm+=2./3*Mc[j]*sin(a);dm-=2./3*Mc[j]*cos(a);}
    double dr=id0,qr=iq0;
    // speed estimate
    double vnew=(me-mlast)/Ts;mlast=me;vest+=(vnew-vest)*(1-exp(-2*PI*P("velbw",60)*Ts));
    if(freeS){ // position ramp there and back
      if(k*Ts>1.0){double goal=(phase==0?1:phase==2?-1:0)*rpm*2*PI/60; double dv=acc*Ts; vcmd+=fmax(-dv,fmin(dv,goal-vcmd));}
      tref+=vcmd*Ts; if(phase==0&&tref-start>turns*2*PI)phase=1; if(phase==1&&fabs(vcmd)<1e-9){wait+=Ts;if(wait>0.5)phase=2;} if(phase==2&&tref<start)phase=3;
      double vs=poskp*(tref-me)+vcmd, ev=vs-vest; wi+=velki*ev*Ts; qr=iq0+(velkp*ev+wi)/(1.5*p*psi);
      if(fabs(qr)>I0)qr=copysign(I0,qr);
    }
#ifdef TABLE
    if(usetab==1){double a=th;double per=P("period",1);a=fmod(a/per,2*PI);if(a<0)a+=2*PI;hci_currents_dq i=hci_table_f32_dq(&TNAME,(uint32_t)(uint64_t)(a/(2*PI)*4294967296.0));dr=i.id_A;qr=i.iq_A;}
#endif
#ifdef TABLET
    if(usetab==2){double a=th;double per=P("period",1);a=fmod(a/per,2*PI);if(a<0)a+=2*PI;hci_currents_dq i=hci_table_f32_dq_torque(&TNAME,(uint32_t)(uint64_t)(a/(2*PI)*4294967296.0),freeS?(float)((qr)*1.5*p*psi):(float)torque);dr=i.id_A;qr=i.iq_A;}
#endif
    if(P("ideal",0)>0){d=dr;q=qr;}
    double we=p*om;
    if(!open){double ed=dr-dm,eq=qr-qm;xd+=bw*R*ed*Ts;xq+=bw*R*eq*Ts;vd=xd+bw*Ldn*ed-we*Lqn*qm;vq=xq+bw*Lqn*eq+we*(Ldn*dm+psi);}
    double Tt=0,tsh=0;
    double ph=tt;double sd=0,sq=0;for(int j=0;j<3;++j){double a=ph-2*PI/3*j;double s=-Vdt*tanh(I[j]/(0.01*I0));sq+=2./3*s*sin(a);sd-=2./3*s*cos(a);}
    double dwe=0,emfa=0;
    for(int s=0;s<sub;++s){
      double a=p*m,H=1e-3*I0,K=1e-3;
      double w0=w(d,q,a),wp=w(d+H,q,a),wn=w(d-H,q,a),qp=w(d,q+H,a),qn=w(d,q-H,a);
      double pd=(wp-wn)/(2*H),pq=(qp-qn)/(2*H),Ldd=(wp-2*w0+wn)/H/H,Lqq=(qp-2*w0+qn)/H/H;
      double Ldq=(w(d+H,q+H,a)-w(d+H,q-H,a)-w(d-H,q+H,a)+w(d-H,q-H,a))/(4*H*H);
      double wt=(w(d,q,a+K)-w(d,q,a-K))/(2*K);
      double pdt=(w(d+H,q,a+K)-w(d-H,q,a+K)-w(d+H,q,a-K)+w(d-H,q,a-K))/(4*H*K);
      double pqt=(w(d,q+H,a+K)-w(d,q-H,a+K)-w(d,q+H,a-K)+w(d,q-H,a-K))/(4*H*K);
      we=p*om;
      double Te=1.5*p*(pd*q-pq*d+wt)+cog(m);
      double fr=freeS?coul*tanh(om/0.01)+visc*om:coul*(om>0?1:-1)+visc*om;
      if(s==0){Tt=Te;emfa=0;double eqv=we*(pd+pqt),edv=we*(pdt-pq);emfa=eqv*sin(a)-edv*cos(a);}
      if(!open){if(P("ideal",0)<=0){double ud=vd+sd-R*d+we*pq-we*pdt,uq=vq+sq-R*q-we*pd-we*pqt,D=Ldd*Lqq-Ldq*Ldq;
        d+=h*(Lqq*ud-Ldq*uq)/D;q+=h*(Ldd*uq-Ldq*ud)/D;}}
      else d=q=0;
      if(freeS){om+=h*(Te-fr-P("weight",0)*sin(m))/J;}
      else {double o0=rpm*2*PI/60;double on=o0*(1+sr1*sin(m+.3)+sr2*sin(2*m+1));dwe=(on-om)/h;om=on;}
      m+=h*om;t+=h;
      tsh=Te-fr-J*(freeS?0:dwe*(k>2));
      // shaft / sensor resonance then lag
      double tin=tsh; if(fres>0){double wr=2*PI*fres,z=0.05;tsv+=h*(wr*wr*(tsh-ts)-2*z*wr*tsv);ts+=h*tsv;tin=ts;}
      if(lag>0)f1+=h*(tin-f1)/lag;else f1=tin;
    }
    double out=f1*(1+tg)+toff+tdr*t+tn*N();
    if(aaf>0){ for(int j=0;j<3;++j){for(int s=0;s<4;++s){double hh=Ts/4;fa[j][1]+=hh*(aaf*aaf*(M[j]-fa[j][0])-1.414*aaf*fa[j][1]);fa[j][0]+=hh*fa[j][1];}M[j]=fa[j][0];}
      for(int s=0;s<4;++s){double hh=Ts/4;ft[1]+=hh*(aaf*aaf*(out-ft[0])-1.414*aaf*ft[1]);ft[0]+=hh*ft[1];}out=ft[0];}
    if(k*Ts>=skip&&k%every==0)printf("%.6f,%.9g,%.9g,%.7g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.8g,%.6g,%.6g,%.6g,%.6g,%.8g\n",k*Ts,me,m,om*30/PI,M[0],M[1],M[2],out,dm,qm,Tt,d,q,emfa,qr,tsh);
  }
}
